// Counts, table and CSV of `bench deviations`.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "apps/deviations/deviation_runs.h"

namespace scattermeter::apps {

// Answers (of a channel each) counted by verdict.
struct DeviationCount {
  int runs = 0;
  int right = 0, wrong_ok = 0, refused = 0;
  int named = 0;            // of the refused
  int wrong_told = 0;       // of the wrong, those that say that they rest on a cause of its name
  int in_interval = 0;      // of the 95 % intervals of the answers, two for each
  double worst_by_std = 0;  // of the wrong
  void add(const JudgedAnswer& answer);
  void add(const DeviationCount& other);
  double answered_share() const;  // NaN for none
  double named_share() const;     // of the refusals; NaN for none
  double coverage95() const;      // of the intervals; NaN for none
};

// Counts of a kind: of each size, and of all.
struct DeviationKindCount {
  const Deviation* kind = nullptr;
  std::vector<DeviationCount> by_size;
  DeviationCount all;
};

struct DeviationSummary {
  std::vector<DeviationKindCount> kinds;  // those that occur, in the order of all_deviations()
  // Of all sizes; of sizes within what the rig states, by rendering.
  DeviationCount total, within;
  DeviationCount dipole, volume;  // of all sizes
};
DeviationSummary summarise(const std::vector<DeviationResult>& results);

// One answer: verdict, run, and the coefficients or the reasons of the refusal; with a line end.
std::string deviation_line(const DeviationResult& result);
// A row for each kind and size, and the totals.
std::string deviation_table(const std::vector<DeviationResult>& results);
// By cause of the budget, over the answers to rigs within what is stated: the share of the stated
// variance that would vanish if the cause were known exactly, and by how much the cause widens the
// stated deviation. In the mean over the answers; causes that no answer has are absent.
std::string deviation_budget_table(const std::vector<DeviationResult>& results);
// A row for each answer.
std::string deviation_csv(const std::vector<DeviationResult>& results);
// The kinds with sizes, units and words.
std::string deviation_list();

}  // namespace scattermeter::apps
