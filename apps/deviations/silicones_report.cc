#include "apps/deviations/silicones_report.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "apps/report/csv.h"
#include "apps/report/text_table.h"

namespace scattermeter::apps {
namespace {

using Align = TextTable::Align;
constexpr std::array<const char*, 3> kChannels = {"R", "G", "B"};

std::string answer_text(const Quantity& q, const AnswerError& error) {
  return fmt::format("{:.4g} +- {:.2g} ({:+.1f} %)", q.value, q.std, 100.0 * error.relative);
}

SiliconeSummary& summary_of(const SiliconeResult& r, std::vector<SiliconeSummary>& all) {
  const auto it = std::find_if(all.begin(), all.end(), [&](const SiliconeSummary& s) {
    return s.body == r.body && s.images == r.images;
  });
  if (it != all.end()) return *it;
  SiliconeSummary& added = all.emplace_back();
  added.body = r.body;
  added.images = r.images;
  return added;
}

// Errors that Hevisov, Foschum and Kienle report for one image of a cube and of a bust against the
// integrating sphere (Photonics 2025, 12, 1118), %.
std::string published(const SiliconeSummary& s, bool absorption) {
  if (s.images != 1) return "-";
  if (s.body == "cube") return absorption ? "5 to 10 %" : "4 to 10 %";
  return absorption ? "16 to 22 %" : "16 to 19 %";
}

}  // namespace

std::vector<SiliconeSummary> summarise(const std::vector<SiliconeResult>& results) {
  std::vector<SiliconeSummary> out;
  for (const SiliconeResult& r : results) {
    SiliconeSummary& s = summary_of(r, out);
    for (const SiliconeAnswer& answer : r.channel) {
      ++s.answers;
      if (answer.judged.verdict == DeviationVerdict::kRefused) continue;
      ++s.answered;
      s.wrong_ok += answer.judged.verdict == DeviationVerdict::kWrongOk ? 1 : 0;
      s.in_interval += answer.judged.in_interval;
      const double of_s = std::abs(answer.judged.sigma_s_prime.relative);
      const double of_a = std::abs(answer.judged.sigma_a.relative);
      s.largest_scattering = std::max(s.largest_scattering, of_s);
      s.largest_absorption = std::max(s.largest_absorption, of_a);
      s.root_mean_square_scattering += of_s * of_s;
      s.root_mean_square_absorption += of_a * of_a;
    }
    s.colour_difference = std::fmax(s.colour_difference, r.colour_difference);
  }
  for (SiliconeSummary& s : out) {
    if (s.answered == 0) continue;
    s.root_mean_square_scattering = std::sqrt(s.root_mean_square_scattering / s.answered);
    s.root_mean_square_absorption = std::sqrt(s.root_mean_square_absorption / s.answered);
  }
  return out;
}

std::string silicones_table(const std::vector<SiliconeResult>& results) {
  TextTable table({{"body", Align::kLeft},
                   {"images"},
                   {"silicone", Align::kLeft},
                   {"", Align::kLeft},
                   {"true sigma_s'"},
                   {"measured [1/mm]"},
                   {"true sigma_a"},
                   {"measured [1/mm]"},
                   {"in 95 %"},
                   {"dE2000"}});
  for (const SiliconeResult& r : results) {
    for (std::size_t c = 0; c < r.channel.size(); ++c) {
      const SiliconeAnswer& a = r.channel[c];
      const bool answered = a.judged.verdict != DeviationVerdict::kRefused;
      table.add_row(
          {c == 0 ? r.body : "", c == 0 ? std::to_string(r.images) : "", c == 0 ? r.silicone : "",
           kChannels[c], fmt::format("{:g}", a.truth.sigma_s_prime_per_mm),
           answered ? answer_text(a.estimate.sigma_s_prime_per_mm, a.judged.sigma_s_prime)
                    : "refused",
           fmt::format("{:g}", a.truth.sigma_a_per_mm),
           answered ? answer_text(a.estimate.sigma_a_per_mm, a.judged.sigma_a) : "refused",
           answered ? fmt::format("{}/2", a.judged.in_interval) : "-",
           c == 0 && std::isfinite(r.colour_difference) ? fmt::format("{:.2f}", r.colour_difference)
                                                        : ""});
    }
  }
  return table.text();
}

std::string silicones_summary_table(const std::vector<SiliconeResult>& results) {
  TextTable table({{"body", Align::kLeft},
                   {"images"},
                   {"answered"},
                   {"wrong ok"},
                   {"sigma_s' off, rms"},
                   {"largest"},
                   {"published"},
                   {"sigma_a off, rms"},
                   {"largest"},
                   {"published"},
                   {"in 95 %"},
                   {"largest dE2000"}});
  const auto percent = [](double share) { return fmt::format("{:.1f} %", 100.0 * share); };
  for (const SiliconeSummary& s : summarise(results)) {
    const bool any = s.answered > 0;
    table.add_row({s.body, std::to_string(s.images), fmt::format("{}/{}", s.answered, s.answers),
                   std::to_string(s.wrong_ok), any ? percent(s.root_mean_square_scattering) : "-",
                   any ? percent(s.largest_scattering) : "-", published(s, false),
                   any ? percent(s.root_mean_square_absorption) : "-",
                   any ? percent(s.largest_absorption) : "-", published(s, true),
                   fmt::format("{}/{}", s.in_interval, 2 * s.answered),
                   any ? fmt::format("{:.2f}", s.colour_difference) : "-"});
  }
  return table.text();
}

std::string silicones_csv(const std::vector<SiliconeResult>& results) {
  Csv csv({"body", "images", "silicone", "draw", "channel", "verdict", "true_sigma_s_prime_per_mm",
           "sigma_s_prime_per_mm", "sigma_s_prime_std_per_mm", "true_sigma_a_per_mm",
           "sigma_a_per_mm", "sigma_a_std_per_mm", "intervals_holding", "colour_difference",
           "seconds", "reasons"});
  for (const SiliconeResult& r : results) {
    for (std::size_t c = 0; c < r.channel.size(); ++c) {
      const SiliconeAnswer& a = r.channel[c];
      csv.add_row(
          {r.body, std::to_string(r.images), r.silicone, std::to_string(r.draw), kChannels[c],
           verdict_name(a.judged.verdict), csv_number(a.truth.sigma_s_prime_per_mm),
           csv_number(a.estimate.sigma_s_prime_per_mm.value),
           csv_number(a.estimate.sigma_s_prime_per_mm.std), csv_number(a.truth.sigma_a_per_mm),
           csv_number(a.estimate.sigma_a_per_mm.value), csv_number(a.estimate.sigma_a_per_mm.std),
           std::to_string(a.judged.in_interval), csv_number(r.colour_difference),
           csv_number(r.seconds), fmt::format("{}", fmt::join(a.estimate.reasons, " "))});
    }
  }
  return csv.text();
}

}  // namespace scattermeter::apps
