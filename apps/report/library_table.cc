#include "apps/report/library_table.h"

#include <algorithm>

#include <fmt/core.h>
#include <fmt/format.h>

#include "apps/report/text_table.h"

namespace scattermeter::apps {
namespace {

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
