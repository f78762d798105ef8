#include "apps/result_table.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

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

// fmt pads by code points, so that "±" counts as one.
std::string row(const std::string& material, std::size_t width, const std::string& channel,
                const std::string& s, const std::string& a, const std::string& residual,
                const std::string& chi2, const std::string& verdict) {
  return fmt::format("{:<{}}  {:<2} {:>20}  {:>24}  {:>8}  {:>6}  {}\n", material, width, channel,
                     s, a, residual, chi2, verdict);
}

}  // namespace

std::string result_table(const Measurement& m) {
  std::size_t width = 8;
  for (const ChannelResult& r : m.results) width = std::max(width, r.material.size());
  std::string out = row("material", width, "ch", "sigma_s' [1/mm]", "sigma_a [1/mm]", "residual",
                        "chi2/n", "verdict");
  std::string last;
  for (const ChannelResult& r : m.results) {
    const Estimate& e = r.estimate;
    const bool known = e.converged;
    out +=
        row(r.material == last ? "" : r.material, width, std::string(1, r.channel),
            with_deviation(e.sigma_s_prime_per_mm, known), with_deviation(e.sigma_a_per_mm, known),
            known ? fmt::format("{:.2f} %", 100.0 * e.rms_relative) : "-",
            known ? fmt::format("{:.2f}", e.reduced_chi2) : "-", r.refused() ? "refused" : "ok");
    last = r.material;
  }
  for (const ChannelResult& r : m.results) {
    for (const std::string& reason : r.estimate.reasons) {
      out += fmt::format("refused: {} {}: {}\n", r.material, r.channel, reason);
    }
  }
  return out;
}

}  // namespace scattermeter::apps
