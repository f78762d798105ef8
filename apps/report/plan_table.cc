#include "apps/report/plan_table.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/core.h>

#include "apps/report/text_table.h"

namespace scattermeter::apps {
namespace {

// The largest shares of the variance of sigma_a: "scale 80 %, pose 15 %".
std::string largest_causes(const Estimate& e) {
  std::vector<BudgetLine> lines = e.budget;
  std::sort(lines.begin(), lines.end(), [](const BudgetLine& x, const BudgetLine& y) {
    return x.std_sigma_a_per_mm > y.std_sigma_a_per_mm;
  });
  std::string out;
  const double all = e.sigma_a_per_mm.std * e.sigma_a_per_mm.std;
  for (std::size_t i = 0; i < std::min<std::size_t>(3, lines.size()); ++i) {
    const double share = lines[i].std_sigma_a_per_mm * lines[i].std_sigma_a_per_mm / all;
    if (!(share > 0.005)) break;
    out += fmt::format("{}{} {:.0f} %", out.empty() ? "" : ", ", lines[i].cause,
                       100.0 * std::min(1.0, share));
  }
  return out;
}

// Shots with the same advice share a line.
std::string exposure_lines(const Plan& plan) {
  std::string out;
  for (const ExposureAdvice& a : plan.exposures) {
    if (!a.advice.empty()) {
      out += fmt::format("exposure: {} {}: {}\n", a.shot, a.channel, a.advice);
    }
  }
  if (!plan.brightness_known) {
    return "exposure: unknown without camera.responsivity_counts_mm2_sr_per_W_s\n";
  }
  if (out.empty()) out = "exposure: nothing clips, nothing is too dark\n";
  return out;
}

std::string gain_lines(const Plan& plan) {
  std::string out;
  for (const SuggestedShots& o : plan.suggested_shots) {
    out += fmt::format("{} {}: sigma_a will be known to {}; this would improve to\n", o.material,
                       o.channel, percent_text(o.planned));
    for (const PlannedChannel& c : plan.channels) {
      if (c.result.material != o.material || c.result.channel != o.channel) continue;
      const Quantity& a = c.result.estimate.sigma_a_per_mm;
      const std::vector<KnownCause> known = known_causes(c.result.estimate);
      for (std::size_t i = 0; i < std::min<std::size_t>(2, known.size()); ++i) {
        out += fmt::format("  {:>7}  with {} known exactly\n",
                           percent_text(known[i].sigma_a_std_per_mm / a.value), known[i].cause);
      }
    }
    for (const Gain& g : o.gains) {
      out += fmt::format("  {:>7}  with {}\n", percent_text(g.sigma_a_ratio * o.planned), g.what);
    }
  }
  return out;
}

}  // namespace

std::string plan_table(const Plan& plan) {
  using Align = TextTable::Align;
  TextTable table({{"material", Align::kLeft},
                   {"ch", Align::kLeft},
                   {"sigma_s' [1/mm]"},
                   {"known to"},
                   {"sigma_a [1/mm]"},
                   {"known to"},
                   {"sigma_a's variance by", Align::kLeft},
                   {"verdict", Align::kLeft}});
  std::string last;
  std::string refusals;
  for (const PlannedChannel& c : plan.channels) {
    const ChannelResult& r = c.result;
    const Medium& m = c.expected.medium;
    const bool known = r.estimate.converged;
    table.add_row({r.material == last ? "" : r.material, std::string(1, r.channel),
                   fmt::format("{:.3g}", m.sigma_s_prime_per_mm),
                   percent_text(relative_range(c, &Estimate::sigma_s_prime_per_mm)),
                   fmt::format("{:.3g}", m.sigma_a_per_mm),
                   percent_text(relative_range(c, &Estimate::sigma_a_per_mm)),
                   known ? largest_causes(r.estimate) : "", r.refused() ? "refused" : "ok"});
    last = r.material;
    for (const std::string& reason : r.estimate.reasons) {
      refusals += fmt::format("refused: {} {}: {}\n", r.material, r.channel, reason);
    }
    for (const Forecast& corner : c.corners) {
      if (corner.estimate.reasons.empty()) continue;
      refusals += fmt::format("refused: {} {} at {:.3g} / {:.3g} per mm: {}\n", r.material,
                              r.channel, corner.medium.sigma_s_prime_per_mm,
                              corner.medium.sigma_a_per_mm, corner.estimate.reasons.front());
    }
  }
  return table.text() + refusals + exposure_lines(plan) + gain_lines(plan);
}

}  // namespace scattermeter::apps
