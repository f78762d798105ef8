#include "apps/report/comparison_table.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>
#include <fmt/format.h>

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
      "a difference of {:.2g} % in sigma_s' or {:.2g} /mm in sigma_a would have been seen in "
      "every channel",
      300.0 * scattering, 3.0 * absorption_per_mm);
}

// "+10 -3 +4", of R, G, B; "-" for a channel that is not measured in both.
std::string percents(const MaterialComparison& m, Quantity ReadChannel::*coefficient,
                     Difference ChannelComparison::*difference) {
  std::vector<std::string> out;
  for (const char channel : {'R', 'G', 'B'}) {
    const auto c = std::find_if(m.channels.begin(), m.channels.end(),
                                [&](const auto& one) { return one.first.channel == channel; });
    if (c == m.channels.end() || !((c->first.*coefficient).value > 0.0)) {
      out.emplace_back("-");
    } else {
      out.push_back(
          fmt::format("{:+.2g}", 100.0 * ((*c).*difference).value / (c->first.*coefficient).value));
    }
  }
  return fmt::format("{}", fmt::join(out, " "));
}

}  // namespace

std::string comparison_sentence(const MaterialComparison& m) {
  if (m.channels.empty()) return fmt::format("{}: no channel is measured in both", names(m));
  if (m.is_different()) {
    return fmt::format("{}: different (p = {:.2g})", names(m), m.p_value);
  }
  return fmt::format("{}: no difference found (p = {:.2g}); {}", names(m), m.p_value, seen(m));
}

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
    verdicts += comparison_sentence(m) + "\n";
  }
  return table.text() + verdicts;
}

std::string library_table(const std::string& name, const std::vector<LibraryMatch>& matches,
                          std::size_t most) {
  using Align = TextTable::Align;
  TextTable table({{"like " + name, Align::kLeft},
                   {"of", Align::kLeft},
                   {"sigma_s' R G B [%]"},
                   {"sigma_a R G B [%]"},
                   {"p"},
                   {"verdict", Align::kLeft}});
  for (std::size_t i = 0; i < std::min(most, matches.size()); ++i) {
    const MaterialComparison& m = matches[i].comparison;
    table.add_row(
        {m.second, matches[i].of,
         percents(m, &ReadChannel::sigma_s_prime_per_mm, &ChannelComparison::sigma_s_prime_per_mm),
         percents(m, &ReadChannel::sigma_a_per_mm, &ChannelComparison::sigma_a_per_mm),
         fmt::format("{:.2g}", m.p_value), m.is_different() ? "different" : "no difference found"});
  }
  if (matches.empty()) return fmt::format("{}: no known material has a channel in common\n", name);
  const MaterialComparison& likest = matches.front().comparison;
  return table.text() +
         (likest.is_different()
              ? fmt::format("{}: likest is {}, but it is another material\n", name, likest.second)
              : fmt::format("{}: may be {}\n", name, likest.second));
}

}  // namespace scattermeter::apps
