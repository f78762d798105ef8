#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <fmt/core.h>

#include "apps/checking/check.h"

namespace scattermeter::apps {
namespace {

// Checks that the joint model of the images judges.
bool is_of_images(const CheckItem& item) {
  static const std::set<std::string> kItems = {"image residual", "light of shot", "LED drift",
                                               "light from elsewhere", "LED place"};
  return kItems.contains(item.what);
}

}  // namespace

std::vector<CheckItem> check_first_look(const CheckedRig& checked) {
  std::vector<CheckDetail> details;
  const std::vector<Finding> findings = checked.findings();
  for (const Finding& f : findings) {
    CheckDetail d;
    d.where = f.text;
    d.value = 1.0;
    if (!f.shots.empty()) d.shot_idx = f.shots.front();
    details.push_back(d);
  }
  if (details.empty()) {
    CheckDetail nothing;
    nothing.where = "outlines, lights, files, units";
    details.push_back(nothing);
  }
  CheckItem item = judged("first look", "contradictions", {0.5},
                          findings.empty() ? "" : findings.front().advice, details);
  if (!findings.empty()) item.where = findings.front().text;
  return {item};
}

std::string probable_cause(const CheckedRig& checked, const std::vector<CheckItem>& items) {
  const std::vector<Finding> findings = checked.findings();
  if (!findings.empty()) return findings.front().sentence();
  const bool failed = std::any_of(items.begin(), items.end(),
                                  [](const CheckItem& i) { return !i.passed && is_of_images(i); });
  if (!failed) return "";
  // Over the channels: what remains of the images' misfit, and what a cause explains of it.
  struct Total {
    double drop = 0.0, share = 0.0;
    std::string advice;
  };
  std::map<std::string, Total> totals;
  double channels = 0.0;
  for (const CheckedChannel& fitted : checked.fit.channels) {
    if (fitted.causes.empty()) continue;
    channels += 1.0;
    for (const ImageCause& cause : fitted.causes) {
      Total& total = totals[cause.text];
      total.drop += cause.chi2_drop / cause.parameters;
      total.share += cause.share;
      total.advice = cause.advice;
    }
  }
  const auto best =
      std::max_element(totals.begin(), totals.end(),
                       [](const auto& a, const auto& b) { return a.second.drop < b.second.drop; });
  constexpr double kLeastShare = 0.5;
  if (best == totals.end() || best->second.share < kLeastShare * channels) return "";
  return fmt::format("{}, which explains {:.0f} % of what the joint model leaves unexplained; {}",
                     best->first, 100.0 * best->second.share / channels, best->second.advice);
}

}  // namespace scattermeter::apps
