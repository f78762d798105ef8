#include "apps/pages/plan_page.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "apps/pages/budget_details.h"
#include "apps/pages/html_page.h"
#include "apps/pages/led_map_plot.h"
#include "apps/pages/page_plots.h"
#include "apps/pages/rig_figure.h"
#include "apps/planning/plan_assumptions.h"
#include "apps/report/result_table.h"
#include "core/base/version.h"

namespace scattermeter::apps {
namespace {

Html forecast_table(const Plan& plan) {
  const bool ranges = std::any_of(plan.channels.begin(), plan.channels.end(),
                                  [](const PlannedChannel& c) { return !c.corners.empty(); });
  HtmlTable table;
  table.header = {"material",       "ch",       "verdict", "sigma_s' [1/mm]", "known to",
                  "sigma_a [1/mm]", "known to", "patches"};
  if (ranges) {
    table.header.insert(table.header.end(),
                        {"sigma_s' over the range", "sigma_a over the range", "refused corners"});
  }
  for (const PlannedChannel& c : plan.channels) {
    const ChannelResult& r = c.result;
    const Estimate& e = r.estimate;
    const Medium& m = c.expected.medium;
    const auto known = [&](const Quantity& q, double expected) {
      return number_cell(e.converged ? percent_text(q.std / expected) : "–");
    };
    std::vector<HtmlTable::Cell> row = {
        text_cell(r.material),
        text_cell(std::string(1, r.channel)),
        r.refused() ? text_cell("refused", "fail") : text_cell("ok", "pass"),
        number_cell(fmt::format("{:.4g}", m.sigma_s_prime_per_mm)),
        known(e.sigma_s_prime_per_mm, m.sigma_s_prime_per_mm),
        number_cell(fmt::format("{:.4g}", m.sigma_a_per_mm)),
        known(e.sigma_a_per_mm, m.sigma_a_per_mm),
        number_cell(std::to_string(e.rows))};
    if (ranges) {
      const auto refused = std::count_if(c.corners.begin(), c.corners.end(), [](const Forecast& f) {
        return !f.estimate.reasons.empty();
      });
      row.push_back(number_cell(percent_text(relative_range(c, &Estimate::sigma_s_prime_per_mm))));
      row.push_back(number_cell(percent_text(relative_range(c, &Estimate::sigma_a_per_mm))));
      row.push_back(number_cell(std::to_string(refused)));
    }
    table.rows.push_back(row);
  }
  return html_table(table);
}

Html refusal_list(const Plan& plan) {
  Html list;
  const auto add = [&](const PlannedChannel& c, const Forecast& f) {
    for (const std::string& reason : f.estimate.reasons) {
      list += html_element(
          "li",
          html_text(fmt::format("{} {} at {:.3g} / {:.3g} per mm would be refused: {}.",
                                c.result.material, c.result.channel, f.medium.sigma_s_prime_per_mm,
                                f.medium.sigma_a_per_mm, reason)));
    }
  };
  for (const PlannedChannel& c : plan.channels) {
    add(c, c.expected);
    for (const Forecast& corner : c.corners) add(c, corner);
  }
  return list.markup.empty() ? Html{} : html_element("ul", list);
}

Html exposure_table(const Plan& plan) {
  HtmlTable table;
  table.header = {"shot",    "ch",       "exposure [s]",  "brightest", "a tenth below",
                  "clipped", "in noise", "suggested [s]", "advice"};
  const auto times = [](const std::vector<double>& list) {
    std::string out;
    for (const double s : list) out += fmt::format("{}{:.3g}", out.empty() ? "" : ", ", s);
    return out;
  };
  for (const ExposureAdvice& a : plan.exposures) {
    table.rows.push_back(
        {text_cell(a.shot), text_cell(std::string(1, a.channel)),
         number_cell(times(a.exposure_s) + (a.chosen ? " (chosen)" : "")),
         number_cell(fmt::format("{:.0f} of {:.0f}", a.brightest_counts, a.range_counts)),
         number_cell(fmt::format("{:.0f}", a.dark_counts)),
         number_cell(percent_text(a.clipped_share)), number_cell(percent_text(a.dark_share)),
         number_cell(times(a.suggested_s)),
         a.advice.empty() ? text_cell("fine", "pass") : text_cell(a.advice, "fail")});
  }
  return html_table(table);
}

// Causes known exactly and additional shots, the most helpful first.
Html gain_table(const SuggestedShots& o, const std::vector<const PlannedChannel*>& channels) {
  std::vector<std::pair<double, std::string>> list;
  for (const Gain& g : o.gains) list.emplace_back(g.sigma_a_ratio, g.what);
  for (const PlannedChannel* c : channels) {
    if (c->result.channel != o.channel) continue;
    for (const KnownCause& known : known_causes(c->result.estimate)) {
      list.emplace_back(known.sigma_a_std_per_mm / c->result.estimate.sigma_a_per_mm.std,
                        known.cause + " known exactly");
    }
  }
  std::stable_sort(list.begin(), list.end(),
                   [](const auto& x, const auto& y) { return x.first < y.first; });
  HtmlTable table;
  table.header = {"with", "sigma_a known to", "of now"};
  for (const auto& [ratio, what] : list) {
    if (!(ratio < 0.99)) continue;
    table.rows.push_back({text_cell(what), number_cell(percent_text(ratio * o.planned)),
                          number_cell(percent_text(ratio))});
  }
  return table.rows.empty() ? Html{} : html_table(table);
}

Html plan_section(const Plan& plan, const std::vector<const PlannedChannel*>& channels) {
  const std::string& material = channels.front()->result.material;
  Html out = html_element("h2", html_text(material));
  if (std::none_of(channels.begin(), channels.end(),
                   [](const PlannedChannel* c) { return c->result.estimate.converged; })) {
    out += html_element("p", html_text("No channel of it would be measured."), "fail");
    return out;
  }
  for (const SuggestedShots& o : plan.suggested_shots) {
    if (o.material != material) continue;
    out += html_element("h3", html_text("What would help"));
    out += html_element(
        "p",
        html_text(fmt::format(
            "Channel {} has the least certain sigma_a: the planned shots determine it to {}.",
            o.channel, percent_text(o.planned))),
        "dim");
    out += gain_table(o, channels);
    std::vector<PagePlot> plots;
    for (const LedMap& m : o.maps) {
      for (const bool joined : {true, false}) plots.push_back(led_map_plot(o, m, joined));
    }
    if (!plots.empty()) {
      out += html_element("h3", html_text("Where to put an LED"));
      out += html_element(
          "p",
          html_text("The upper hemisphere about the object, seen from above: the zenith in the "
                    "centre, the horizon at the dashed circle."),
          "dim");
      out += plot_figures(plots);
    }
  }
  Html budgets;
  for (const PlannedChannel* c : channels) {
    budgets += budget_details(c->result.channel, c->result.estimate);
  }
  if (!budgets.markup.empty()) {
    out += html_element("h3", html_text("Where the uncertainty will come from"));
    out += html_element("p", html_text(kBudgetLegend), "dim");
    out += budgets;
  }
  return out;
}

}  // namespace

std::string plan_page(const Plan& plan, const std::string& command_line) {
  const auto refused = std::count_if(plan.channels.begin(), plan.channels.end(),
                                     [](const PlannedChannel& c) { return c.result.refused(); });
  Html body = html_element("h1", html_text("Expected uncertainty of these shots"));
  body += html_element(
      "p",
      html_text(refused == 0 ? fmt::format("All {} values will be measured.", plan.channels.size())
                             : fmt::format("{} of {} values would be refused.", refused,
                                           plan.channels.size())),
      refused == 0 ? "pass" : "fail");
  double total_s = 0.0;
  for (const auto& [stage, seconds] : plan.timing_s) {
    if (stage == "total") total_s = seconds;
  }
  body += html_element(
      "p",
      html_text(fmt::format("{} ({:.1f} s, scattermeter {})", command_line, total_s, kVersion)),
      "dim");
  body += forecast_table(plan);
  body += refusal_list(plan);
  if (plan.places) {
    body += html_element("h2", html_text("The rig"));
    body += rig_figure(*plan.places);
  }
  body += html_element("h2", html_text("Exposures"));
  const auto advised = std::count_if(plan.exposures.begin(), plan.exposures.end(),
                                     [](const ExposureAdvice& a) { return !a.advice.empty(); });
  body += html_element(
      "p",
      html_text(
          !plan.brightness_known
              ? "The brightness of the shots cannot be predicted: the rig has no responsivity."
          : advised == 0 ? "Nothing clips, nothing is too dark."
                         : fmt::format("{} of {} need another exposure time.", advised,
                                       plan.exposures.size())),
      !plan.brightness_known ? "dim"
      : advised == 0         ? "pass"
                             : "fail");
  body += html_details("counts above black of every shot", exposure_table(plan));
  for (std::size_t i = 0; i < plan.channels.size();) {
    std::vector<const PlannedChannel*> channels;
    const std::string& material = plan.channels[i].result.material;
    for (; i < plan.channels.size() && plan.channels[i].result.material == material; ++i) {
      channels.push_back(&plan.channels[i]);
    }
    body += plan_section(plan, channels);
  }
  body += html_element("h2", html_text("Assumptions"));
  Html list;
  for (const std::string& sentence : plan_assumptions(plan)) {
    list += html_element("li", html_text(sentence));
  }
  body += html_element("ul", list);
  return html_document("Expected uncertainty of these shots", body);
}

}  // namespace scattermeter::apps
