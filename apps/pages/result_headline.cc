#include "apps/pages/result_headline.h"

#include <algorithm>
#include <map>
#include <vector>

#include <fmt/core.h>
#include <fmt/format.h>

#include "core/fit/prior_pulls.h"

namespace scattermeter::apps {
namespace {

// "0.20 … 0.22 %", or "0.20 %" where all are alike.
std::string range_text(std::vector<double> relative) {
  std::sort(relative.begin(), relative.end());
  const std::string low = fmt::format("{:.2g}", 100.0 * relative.front());
  const std::string high = fmt::format("{:.2g}", 100.0 * relative.back());
  return low == high ? low + " %" : fmt::format("{} … {} %", low, high);
}

}  // namespace

std::string precision_sentence(const Measurement& m) {
  std::vector<double> s, a;
  for (const ChannelResult& r : m.results) {
    if (r.refused()) continue;
    const auto add = [](const Quantity& q, std::vector<double>& list) {
      if (!is_undetermined(q)) list.push_back(q.std / q.value);
    };
    add(r.estimate.sigma_s_prime_per_mm, s);
    add(r.estimate.sigma_a_per_mm, a);
  }
  if (s.empty()) return "";
  return fmt::format("sigma_s' is known to {}{} (one standard deviation).", range_text(s),
                     a.empty() ? "" : ", sigma_a to " + range_text(a));
}

std::string rests_on_sentence(const Measurement& m) {
  std::map<std::string, std::vector<std::string>> values;
  int resting = 0;
  for (const ChannelResult& r : m.results) {
    if (r.refused()) continue;
    const std::vector<PriorPull> on = rests_on(r.estimate);
    resting += on.empty() ? 0 : 1;
    for (const PriorPull& p : on) {
      values[p.group].push_back(fmt::format("{} {}", r.material, r.channel));
    }
  }
  std::vector<std::string> causes;
  for (const auto& [cause, of] : values) {
    causes.push_back(fmt::format("{} ({})", cause, fmt::join(of, ", ")));
  }
  if (causes.empty()) return "";
  return fmt::format("{} of {} values {} on what the rig states and these shots cannot test: {}.",
                     resting, m.results.size(), resting == 1 ? "rests" : "rest",
                     fmt::join(causes, "; "));
}

std::string next_sentence(const Measurement& m) {
  if (m.any_refused()) return "Next: see to the reasons of the refusals, in their order.";
  std::map<std::string, int> largest;
  int values = 0;
  const auto count = [&](const Estimate& e, double BudgetLine::*std) {
    const auto at =
        std::max_element(e.budget.begin(), e.budget.end(),
                         [&](const BudgetLine& x, const BudgetLine& y) { return x.*std < y.*std; });
    if (at == e.budget.end()) return;
    ++largest[at->cause];
    ++values;
  };
  for (const ChannelResult& r : m.results) {
    count(r.estimate, &BudgetLine::std_sigma_s_prime_per_mm);
    count(r.estimate, &BudgetLine::std_sigma_a_per_mm);
  }
  if (largest.empty()) return "";
  const auto most =
      std::max_element(largest.begin(), largest.end(),
                       [](const auto& x, const auto& y) { return x.second < y.second; });
  return fmt::format("The largest cause of uncertainty in {} of {} coefficients is {}; {}.",
                     most->second, values, most->first,
                     most->first == "noise" ? "more light or more shots would help most"
                                            : "knowing it better would help most");
}

}  // namespace scattermeter::apps
