#include "apps/deviations/deviation_report.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include <fmt/core.h>
#include <fmt/format.h>

#include "apps/report/csv.h"
#include "apps/report/text_table.h"
#include "core/fit/prior_pulls.h"

namespace scattermeter::apps {
namespace {

double share(int part, int whole) {
  return whole > 0 ? static_cast<double>(part) / whole : std::numeric_limits<double>::quiet_NaN();
}

std::string percent(int part, int whole) {
  return whole > 0 ? fmt::format("{:.0f} %", 100.0 * share(part, whole)) : "-";
}

const char* channel_name(std::size_t channel) {
  static constexpr std::array<const char*, 3> kNames = {"R", "G", "B"};
  return kNames[channel];
}

std::string size_text(const DeviationRun& run) {
  const Deviation& kind = *run.kind;
  if (kind.sizes.size() == 1) return "";
  return fmt::format("{:g}{}{}", kind.sizes[run.size_idx], kind.unit.empty() ? "" : " ", kind.unit);
}

void add_row(TextTable& table, const std::string& kind, const std::string& size, const char* mark,
             const DeviationCount& n) {
  table.add_row({kind, size, mark, std::to_string(n.runs), std::to_string(n.wrong_ok),
                 n.wrong_ok > 0 ? std::to_string(n.wrong_told) : "-",
                 n.wrong_ok > 0 ? fmt::format("{:.1f}", n.worst_by_std) : "-",
                 percent(n.right + n.wrong_ok, n.runs), percent(n.refused, n.runs),
                 percent(n.named, n.refused), percent(n.in_interval, 2 * (n.right + n.wrong_ok))});
}

// The share of the variance that a cause adds to one coefficient, summed over answers.
struct CauseShare {
  double variance = 0, wider = 0;
  void add(double by_cause, double std) {
    const double share = std > 0.0 ? std::min(by_cause * by_cause / (std * std), 1.0) : 0.0;
    variance += share;
    // Bounded: nearly all of a variance may be by one cause.
    wider += 1.0 / std::sqrt(std::max(1.0 - share, 1e-4)) - 1.0;
  }
};

}  // namespace

void DeviationCount::add(const JudgedAnswer& answer) {
  ++runs;
  right += answer.verdict == DeviationVerdict::kRight ? 1 : 0;
  wrong_ok += answer.verdict == DeviationVerdict::kWrongOk ? 1 : 0;
  refused += answer.verdict == DeviationVerdict::kRefused ? 1 : 0;
  named += answer.names_cause && answer.verdict == DeviationVerdict::kRefused ? 1 : 0;
  wrong_told += answer.names_cause && answer.verdict == DeviationVerdict::kWrongOk ? 1 : 0;
  in_interval += answer.in_interval;
  worst_by_std = std::max(worst_by_std, answer.wrong_by_std);
}

void DeviationCount::add(const DeviationCount& other) {
  runs += other.runs;
  right += other.right;
  wrong_ok += other.wrong_ok;
  refused += other.refused;
  named += other.named;
  wrong_told += other.wrong_told;
  in_interval += other.in_interval;
  worst_by_std = std::max(worst_by_std, other.worst_by_std);
}

double DeviationCount::answered_share() const { return share(right + wrong_ok, runs); }
double DeviationCount::named_share() const { return share(named, refused); }
double DeviationCount::coverage95() const { return share(in_interval, 2 * (right + wrong_ok)); }

DeviationSummary summarise(const std::vector<DeviationResult>& results) {
  DeviationSummary out;
  for (const Deviation& kind : all_deviations()) {
    DeviationKindCount count{&kind, std::vector<DeviationCount>(kind.sizes.size()), {}};
    for (const DeviationResult& r : results) {
      if (r.run.kind != &kind) continue;
      count.by_size[r.run.size_idx].add(r.judged);
      count.all.add(r.judged);
      (r.run.volume ? out.volume : out.dipole).add(r.judged);
      if (r.run.within()) out.within.add(r.judged);
    }
    if (count.all.runs == 0) continue;
    out.total.add(count.all);
    out.kinds.push_back(count);
  }
  return out;
}

// "even light -3.1, scale 2.0": the largest pulls of the rig's quantities.
std::string largest_pulls(std::vector<PriorPull> pulls) {
  constexpr std::size_t kShown = 3;
  const std::size_t n = std::min(kShown, pulls.size());
  std::partial_sort(
      pulls.begin(), pulls.begin() + static_cast<std::ptrdiff_t>(n), pulls.end(),
      [](const PriorPull& a, const PriorPull& b) { return std::abs(a.pull) > std::abs(b.pull); });
  std::string out;
  for (std::size_t i = 0; i < n; ++i) {
    out += fmt::format("{}{} {:.1f}", i > 0 ? ", " : "", pulls[i].name, pulls[i].pull);
  }
  return out;
}

// "scale 12.3, eta 7.1": what the answer rests on, by how many deviations each may shift it unseen.
std::string untested(const Estimate& e) {
  std::vector<std::string> out;
  for (const PriorPull& p : rests_on(e)) {
    out.push_back(fmt::format("{} {:.1f}", p.group, unseen_in_std(p, e)));
  }
  return fmt::format("{}", fmt::join(out, ", "));
}

std::string deviation_line(const DeviationResult& r) {
  const auto coefficient = [](const char* name, const Quantity& q, const AnswerError& e) {
    return fmt::format("{} {:.4g} +- {:.2g} ({:+.1f} %, {:+.1f} s)", name, q.value, q.std,
                       100.0 * e.relative, e.in_std);
  };
  const Estimate& e = r.estimate;
  const std::string answer =
      e.reasons.empty() ? coefficient("sigma_s'", e.sigma_s_prime_per_mm, r.judged.sigma_s_prime) +
                              "; " + coefficient("sigma_a", e.sigma_a_per_mm, r.judged.sigma_a)
                        : fmt::format("{}", fmt::join(e.reasons, " "));
  return fmt::format(
      "{}: {} {}, {}, {} LED{}, {}, {}, seed {}: {} (pulls: {}; rests on: {}; chi2/n {:.2f}, "
      "{:.1f} s)\n",
      verdict_name(r.judged.verdict), r.run.kind->name, size_text(r.run), r.run.body, r.run.leds,
      r.run.leds > 1 ? "s" : "", r.run.volume ? "volume" : "dipole",
      deviation_media()[r.channel].name, r.run.seed, answer, largest_pulls(e.pulls), untested(e),
      e.reduced_chi2, r.seconds);
}

std::string deviation_table(const std::vector<DeviationResult>& results) {
  using Align = TextTable::Align;
  const DeviationSummary summary = summarise(results);
  TextTable table({{"deviation", Align::kLeft},
                   {"size", Align::kLeft},
                   {"", Align::kLeft},
                   {"answers"},
                   {"wrong ok"},
                   {"told"},
                   {"worst [s]"},
                   {"answered"},
                   {"refused"},
                   {"by name"},
                   {"in 95 %"}});
  for (const DeviationKindCount& k : summary.kinds) {
    bool is_first = true;
    for (std::size_t s = 0; s < k.by_size.size(); ++s) {
      if (k.by_size[s].runs == 0) continue;
      DeviationRun run;
      run.kind = k.kind;
      run.size_idx = s;
      const char* mark = run.within() ? "within" : "";
      add_row(table, is_first ? k.kind->name : "", size_text(run), mark, k.by_size[s]);
      is_first = false;
    }
  }
  add_row(table, "rendered by the dipole", "", "", summary.dipole);
  add_row(table, "rendered by volume", "", "", summary.volume);
  add_row(table, "all", "", "", summary.total);
  add_row(table, "within what the rig states", "", "within", summary.within);
  return table.text();
}

std::string deviation_budget_table(const std::vector<DeviationResult>& results) {
  std::map<std::string, std::array<CauseShare, 2>> causes;
  int answers = 0;
  for (const DeviationResult& r : results) {
    const Estimate& e = r.estimate;
    if (!r.run.within() || !e.reasons.empty()) continue;
    ++answers;
    for (const BudgetLine& line : e.budget) {
      std::array<CauseShare, 2>& of = causes[line.cause];
      of[0].add(line.std_sigma_s_prime_per_mm, e.sigma_s_prime_per_mm.std);
      of[1].add(line.std_sigma_a_per_mm, e.sigma_a_per_mm.std);
    }
  }
  using Align = TextTable::Align;
  TextTable table({{"cause", Align::kLeft},
                   {"of sigma_s' variance"},
                   {"wider by"},
                   {"of sigma_a variance"},
                   {"wider by"}});
  const auto mean = [&](double sum) { return fmt::format("{:.1f} %", 100.0 * sum / answers); };
  for (const auto& [cause, of] : causes) {
    table.add_row(
        {cause, mean(of[0].variance), mean(of[0].wider), mean(of[1].variance), mean(of[1].wider)});
  }
  return causes.empty() ? "" : table.text();
}

std::string deviation_csv(const std::vector<DeviationResult>& results) {
  Csv csv({"deviation",
           "size",
           "unit",
           "within",
           "body",
           "leds",
           "rendering",
           "medium",
           "channel",
           "seed",
           "verdict",
           "sigma_s_prime_per_mm",
           "sigma_s_prime_std_per_mm",
           "sigma_s_prime_error_relative",
           "sigma_s_prime_error_in_std",
           "sigma_a_per_mm",
           "sigma_a_std_per_mm",
           "sigma_a_error_relative",
           "sigma_a_error_in_std",
           "reduced_chi2",
           "rms_relative",
           "names_cause",
           "largest_pulls",
           "rests_on",
           "seconds",
           "reasons"});
  for (const DeviationResult& r : results) {
    const Estimate& e = r.estimate;
    csv.add_row(
        {r.run.kind->name,
         csv_number(r.run.kind->sizes[r.run.size_idx]),
         r.run.kind->unit,
         r.run.within() ? "yes" : "no",
         r.run.body,
         std::to_string(r.run.leds),
         r.run.volume ? "volume" : "dipole",
         deviation_media()[r.channel].name,
         channel_name(r.channel),
         std::to_string(r.run.seed),
         verdict_name(r.judged.verdict),
         csv_number(e.sigma_s_prime_per_mm.value),
         csv_number(e.sigma_s_prime_per_mm.std),
         csv_number(answer_error(e.sigma_s_prime_per_mm, r.truth.sigma_s_prime_per_mm).relative),
         csv_number(answer_error(e.sigma_s_prime_per_mm, r.truth.sigma_s_prime_per_mm).in_std),
         csv_number(e.sigma_a_per_mm.value),
         csv_number(e.sigma_a_per_mm.std),
         csv_number(answer_error(e.sigma_a_per_mm, r.truth.sigma_a_per_mm).relative),
         csv_number(answer_error(e.sigma_a_per_mm, r.truth.sigma_a_per_mm).in_std),
         csv_number(e.reduced_chi2),
         csv_number(e.rms_relative),
         e.reasons.empty() ? "" : (r.judged.names_cause ? "yes" : "no"),
         largest_pulls(e.pulls),
         untested(e),
         csv_number(r.seconds),
         fmt::format("{}", fmt::join(e.reasons, " "))});
  }
  return csv.text();
}

std::string deviation_list() {
  using Align = TextTable::Align;
  TextTable table({{"deviation", Align::kLeft},
                   {"sizes", Align::kLeft},
                   {"unit", Align::kLeft},
                   {"within what is stated"},
                   {"a refusal names one of", Align::kLeft}});
  for (const Deviation& kind : all_deviations()) {
    table.add_row({kind.name, fmt::format("{:g}", fmt::join(kind.sizes, ", ")), kind.unit,
                   std::to_string(kind.within), fmt::format("{}", fmt::join(kind.words, ", "))});
  }
  return table.text();
}

}  // namespace scattermeter::apps
