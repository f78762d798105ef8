#include "apps/page_plots.h"

#include <stdexcept>

#include <oneapi/tbb/parallel_for.h>

#include "core/input_error.h"

namespace scattermeter::apps {

Html plot_figures(const std::vector<PagePlot>& plots) {
  std::vector<Html> figures(plots.size());
  tbb::parallel_for(std::size_t{0}, plots.size(), [&](std::size_t i) {
    Plot plot = plots[i].plot;
    plot.width_px = kPagePlotWidth_px;
    plot.height_px = plot.equal_axes ? kPagePlotWidth_px : kPagePlotHeight_px;
    try {
      figures[i] = html_figure(data_address("image/svg+xml", plot_svg(plot)), plots[i].caption,
                               html_text(plots[i].caption));
    } catch (const std::invalid_argument&) {
      figures[i] = {};
    } catch (const InputError& e) {
      figures[i] = html_element("p", html_text(plots[i].caption + ": " + e.what()), "dim");
    }
  });
  return html_figures(figures);
}

}  // namespace scattermeter::apps
