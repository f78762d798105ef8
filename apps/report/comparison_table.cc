#include "apps/report/comparison_table.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "apps/report/result_table.h"
#include "apps/report/text_table.h"

namespace scattermeter::apps {
namespace {

std::string difference_text(const Difference& d, double of) {
  return fmt::format("{:+.2g} % ({:+.1f} std)", 100.0 * d.value / of, d.value / d.std);
}

std::string names(const MaterialComparison& m) {
  return m.first == m.second ? m.first : m.first + " and " + m.second;
}

// What would have been seen at three deviations, in the worst channel.
std::string seen(const MaterialComparison& m) {
  double scattering = 0.0, absorption_per_mm = 0.0;
  for (const ChannelComparison& c : m.channels) {
    scattering =
        std::max(scattering, c.sigma_s_prime_per_mm.std / c.first.sigma_s_prime_per_mm.value);
    absorption_per_mm = std::max(absorption_per_mm, c.sigma_a_per_mm.std);
  }
  return fmt::format(
      "one of {:.2g} % in sigma_s' or {:.2g} /mm in sigma_a would have shown in every "
      "channel",
      300.0 * scattering, 3.0 * absorption_per_mm);
}

std::string verdict(const MaterialComparison& m) {
  if (m.channels.empty()) return fmt::format("{}: no channel is measured in both\n", names(m));
  if (m.is_different()) {
    return fmt::format("{}: different (p = {:.2g})\n", names(m), m.p_value);
  }
  return fmt::format("{}: no difference found (p = {:.2g}); {}\n", names(m), m.p_value, seen(m));
}

}  // namespace

std::string comparison_table(const std::vector<MaterialComparison>& materials) {
  using Align = TextTable::Align;
  TextTable table({{"material", Align::kLeft},
                   {"ch"},
                   {"sigma_s' [1/mm]"},
                   {"second"},
                   {"difference"},
                   {"sigma_a [1/mm]"},
                   {"second"},
                   {"difference"},
                   {"p"}});
  std::string verdicts;
  for (const MaterialComparison& m : materials) {
    for (const ChannelComparison& c : m.channels) {
      table.add_row({names(m), std::string(1, c.first.channel),
                     value_with_deviation(c.first.sigma_s_prime_per_mm),
                     value_with_deviation(c.second.sigma_s_prime_per_mm),
                     difference_text(c.sigma_s_prime_per_mm, c.first.sigma_s_prime_per_mm.value),
                     value_with_deviation(c.first.sigma_a_per_mm),
                     value_with_deviation(c.second.sigma_a_per_mm),
                     fmt::format("{:+.1f} std", c.sigma_a_per_mm.value / c.sigma_a_per_mm.std),
                     fmt::format("{:.2g}", c.p_value)});
    }
    verdicts += verdict(m);
  }
  return table.text() + verdicts;
}

}  // namespace scattermeter::apps
