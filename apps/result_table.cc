#include "apps/result_table.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "apps/text_table.h"

namespace scattermeter::apps {
namespace {

// "2.193 ± 0.012": as many decimals as two digits of the deviation need.
std::string with_deviation(const Quantity& q, bool known) {
  if (!known) return "-";
  int decimals = 4;
  if (q.std > 0.0 && std::isfinite(q.std)) {
    decimals = std::clamp(1 - static_cast<int>(std::floor(std::log10(q.std))), 0, 8);
  }
  return fmt::format("{:.{}f} ± {:.{}f}", q.value, decimals, q.std, decimals);
}

}  // namespace

std::string result_table(const Measurement& m) {
  using Align = TextTable::Align;
  TextTable table({{"material", Align::kLeft},
                   {"ch", Align::kLeft},
                   {"sigma_s' [1/mm]"},
                   {"sigma_a [1/mm]"},
                   {"residual"},
                   {"chi2/n"},
                   {"verdict", Align::kLeft}});
  std::string last;
  for (const ChannelResult& r : m.results) {
    const Estimate& e = r.estimate;
    const bool known = e.converged;
    table.add_row(
        {r.material == last ? "" : r.material, std::string(1, r.channel),
         with_deviation(e.sigma_s_prime_per_mm, known), with_deviation(e.sigma_a_per_mm, known),
         known ? fmt::format("{:.2f} %", 100.0 * e.rms_relative) : "-",
         known ? fmt::format("{:.2f}", e.reduced_chi2) : "-", r.refused() ? "refused" : "ok"});
    last = r.material;
  }
  std::string out = table.text();
  for (const ChannelResult& r : m.results) {
    for (const std::string& reason : r.estimate.reasons) {
      out += fmt::format("refused: {} {}: {}\n", r.material, r.channel, reason);
    }
  }
  return out;
}

}  // namespace scattermeter::apps
