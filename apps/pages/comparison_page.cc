#include "apps/pages/comparison_page.h"

#include <fmt/core.h>

#include "apps/pages/html_page.h"
#include "apps/pages/page_plots.h"
#include "apps/report/comparison_table.h"
#include "apps/report/result_table.h"
#include "core/base/version.h"

namespace scattermeter::apps {
namespace {

// Both differences in percent of the first result, over the channels.
PagePlot difference_plot(const MaterialComparison& m) {
  PagePlot out;
  out.plot.title = m.first == m.second ? m.first : m.first + " and " + m.second;
  out.plot.x = {"channel (1 R, 2 G, 3 B)", false, 0.5, 3.5};
  out.plot.y = {"second minus first [%]"};
  const auto add = [&](const char* name, std::size_t look, double shift,
                       Quantity ReadChannel::*coefficient, Difference ChannelComparison::*of) {
    PlotSeries series{name, PlotSeries::Style::kPoints, {}, {}};
    series.look = look;
    for (const ChannelComparison& c : m.channels) {
      const double percent = 100.0 / (c.first.*coefficient).value;
      series.x.push_back(1.0 + static_cast<double>(std::string("RGB").find(c.first.channel)) +
                         shift);
      series.y.push_back(percent * (c.*of).value);
      series.y_std.push_back(percent * (c.*of).std);
    }
    out.plot.series.push_back(series);
  };
  add("sigma_s'", 0, -0.06, &ReadChannel::sigma_s_prime_per_mm,
      &ChannelComparison::sigma_s_prime_per_mm);
  add("sigma_a", 4, 0.06, &ReadChannel::sigma_a_per_mm, &ChannelComparison::sigma_a_per_mm);
  out.caption = comparison_sentence(m) + ". Differences with one standard deviation.";
  return out;
}

}  // namespace

std::string comparison_page(const std::vector<MaterialComparison>& materials,
                            const std::string& first, const std::string& second,
                            const std::string& rigs, const std::string& command_line) {
  const std::string title = "Are these the same material?";
  Html body = html_element("h1", html_text(title));
  HtmlTable table;
  table.header = {"materials",      "ch",     "sigma_s' [1/mm]", "second", "difference",
                  "sigma_a [1/mm]", "second", "difference",      "p"};
  std::vector<PagePlot> plots;
  for (const MaterialComparison& m : materials) {
    body += html_element("p", html_text(comparison_sentence(m) + "."),
                         m.is_different() ? "fail" : "pass");
    for (const ChannelComparison& c : m.channels) {
      const auto in_stds = [](const Difference& d) {
        return number_cell(fmt::format("{:+.1f} std", d.value / d.std));
      };
      table.rows.push_back({text_cell(m.first == m.second ? m.first : m.first + ", " + m.second),
                            text_cell(std::string(1, c.first.channel)),
                            number_cell(value_with_deviation(c.first.sigma_s_prime_per_mm)),
                            number_cell(value_with_deviation(c.second.sigma_s_prime_per_mm)),
                            in_stds(c.sigma_s_prime_per_mm),
                            number_cell(value_with_deviation(c.first.sigma_a_per_mm)),
                            number_cell(value_with_deviation(c.second.sigma_a_per_mm)),
                            in_stds(c.sigma_a_per_mm),
                            number_cell(fmt::format("{:.2g}", c.p_value))});
    }
    if (!m.channels.empty()) plots.push_back(difference_plot(m));
  }
  body += html_element("p",
                       html_text(fmt::format("First: {}; second: {}; {}. {} (scattermeter {})",
                                             first, second, rigs, command_line, kVersion)),
                       "dim");
  body += html_table(table);
  body += plot_figures(plots);
  return html_document(title, body);
}

}  // namespace scattermeter::apps
