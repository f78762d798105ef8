#include "apps/pages/page_plots.h"

#include <stdexcept>
#include <string>

#include "core/base/input_error.h"

namespace scattermeter::apps {

Html plot_figures(const std::vector<PagePlot>& plots) {
  std::vector<Plot> sized;
  for (const PagePlot& p : plots) {
    Plot& plot = sized.emplace_back(p.plot);
    plot.width_px = kPagePlotWidth_px;
    plot.height_px = plot.equal_axes ? kPagePlotWidth_px : kPagePlotHeight_px;
  }
  std::vector<std::string> svgs;
  try {
    svgs = plot_svgs(sized);
  } catch (const std::invalid_argument&) {
  } catch (const InputError&) {
  }
  std::vector<Html> figures(plots.size());
  for (std::size_t i = 0; i < plots.size(); ++i) {
    try {
      // A plot that cannot be drawn must not hide the others.
      const std::string svg = svgs.empty() ? plot_svg(sized[i]) : svgs[i];
      figures[i] = html_figure(data_address("image/svg+xml", svg), plots[i].caption,
                               html_text(plots[i].caption));
    } catch (const std::invalid_argument&) {
      figures[i] = {};
    } catch (const InputError& e) {
      figures[i] = html_element("p", html_text(plots[i].caption + ": " + e.what()), "dim");
    }
  }
  return html_figures(figures);
}

}  // namespace scattermeter::apps
