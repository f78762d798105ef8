#include "apps/report/result_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/core.h>

#include "apps/report/text_table.h"

namespace scattermeter::apps {

std::string value_with_deviation(const Quantity& q) {
  if (is_upper_limit(q)) return fmt::format("< {:.2g}", q.high95);
  int decimals = 4;
  if (q.std > 0.0 && std::isfinite(q.std)) {
    decimals = std::clamp(1 - static_cast<int>(std::floor(std::log10(q.std))), 0, 8);
  }
  return fmt::format("{:.{}f} ± {:.{}f}", q.value, decimals, q.std, decimals);
}

std::string patches_text(const std::array<std::size_t, kRowStates>& by_state, std::size_t partly) {
  std::string out = fmt::format("{} in use, {} at silhouettes or creases left out",
                                by_state[static_cast<std::size_t>(RowState::kUsed)], partly);
  for (const auto& [state, text] :
       {std::pair{RowState::kNoSamples, "without a sample of the colour"},
        std::pair{RowState::kClipped, "clipped"}, std::pair{RowState::kFloor, "cut at zero"},
        std::pair{RowState::kMirror, "mirror a light"},
        std::pair{RowState::kNoise, "deep in noise"}, std::pair{RowState::kOutlier, "outliers"},
        std::pair{RowState::kEdge, "at edges"}}) {
    const std::size_t n = by_state[static_cast<std::size_t>(state)];
    if (n > 0) out += fmt::format(", {} {}", n, text);
  }
  return out;
}

std::string bracket_text(const MergedBracket& bracket) {
  const auto sum = [](const std::array<std::size_t, kRgb>& counts) {
    return static_cast<double>(counts[0] + counts[1] + counts[2]);
  };
  const double percent = 100.0 / std::max(1.0, sum(bracket.samples));
  std::string out = fmt::format("{}: {} files merged", bracket.shot, bracket.files.size());
  for (const MergedBracket::File& f : bracket.files) {
    out += fmt::format(", {} ({:g} s) in {:.1f} %", f.file, f.exposure_s, percent * sum(f.samples));
  }
  return out + fmt::format(" of the samples on the object; {:.1f} % clipped in all",
                           percent * sum(bracket.samples_clipped));
}

namespace {

std::string with_deviation(const Quantity& q, bool known) {
  return known && std::isfinite(q.std) ? value_with_deviation(q) : "-";
}

// Why patches were excluded, summed over shots and channels: "3 clipped, 12 mirror a light".
std::string left_out(const Measurement& m) {
  std::array<std::size_t, kRowStates> sum{};
  std::size_t partly = 0;
  for (const ChannelResult& r : m.results) {
    for (std::size_t s = 0; s < kRowStates; ++s) sum[s] += r.patches_by_state[s];
    partly += r.patches_partly_seen;
  }
  return "patches: " + patches_text(sum, partly) + " (all shots and channels)\n";
}

// Materials whose shots disagree.
std::string agreement(const Measurement& m) {
  std::string out;
  std::size_t compared = 0;
  for (const ChannelResult& r : m.results) {
    if (r.agreement.dof == 0) continue;
    ++compared;
    if (!r.agreement.disagree()) continue;
    out +=
        fmt::format("note: {} {}: the shots do not agree (p = {:.1g}); uncertainties increased\n",
                    r.material, r.channel, r.agreement.p_value);
  }
  if (compared > 0 && out.empty() && !m.any_refused()) {
    out = "each single shot agrees with the joint estimate\n";
  }
  return out;
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
                   {"model", Align::kLeft},
                   {"verdict", Align::kLeft}});
  const auto add = [&](const std::string& material, const std::string& channel, const Estimate& e,
                       const std::string& model, const std::string& verdict) {
    const bool known = e.converged;
    table.add_row({material, channel, with_deviation(e.sigma_s_prime_per_mm, known),
                   with_deviation(e.sigma_a_per_mm, known),
                   known ? fmt::format("{:.2f} %", 100.0 * e.rms_relative) : "-",
                   known ? fmt::format("{:.2f}", e.reduced_chi2) : "-", model, verdict});
  };
  std::string last;
  for (const ChannelResult& r : m.results) {
    add(r.material == last ? "" : r.material, std::string(1, r.channel), r.estimate, r.model,
        r.refused() ? "refused" : "ok");
    last = r.material;
    if (!r.dipole) continue;
    const std::optional<DipoleDistance> far = dipole_distance(r);
    add("", "", *r.dipole, "(dipole)",
        far ? fmt::format("{:+.2g} %, {:+.1g} /mm", 100.0 * far->sigma_s_prime_relative,
                          far->sigma_a_per_mm)
        : is_undetermined(r.dipole->sigma_s_prime_per_mm) ? "undetermined"
                                                          : "");
  }
  std::string out = table.text() + left_out(m);
  for (const MergedBracket& b : m.brackets) out += "bracket " + bracket_text(b) + "\n";
  out += agreement(m);
  for (const ChannelResult& r : m.results) {
    const std::string on = r.refused() ? "" : rests_on_sentence(r.estimate);
    if (!on.empty()) out += fmt::format("note: {} {}: {}\n", r.material, r.channel, on);
    for (const std::string& reason : r.estimate.reasons) {
      out += fmt::format("refused: {} {}: {}\n", r.material, r.channel, reason);
    }
  }
  return out;
}

}  // namespace scattermeter::apps
