#include "apps/pages/budget_details.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/core.h>

namespace scattermeter::apps {
namespace {

double share_of(double std, double whole) {
  const double part = whole > 0.0 ? std::clamp(std * std / (whole * whole), 0.0, 1.0) : 0.0;
  return std::isfinite(part) ? part : 0.0;
}

double share_of_s(const BudgetLine& line, const Estimate& e) {
  return share_of(line.std_sigma_s_prime_per_mm, e.sigma_s_prime_per_mm.std);
}

double share_of_a(const BudgetLine& line, const Estimate& e) {
  return share_of(line.std_sigma_a_per_mm, e.sigma_a_per_mm.std);
}

// "mesh scale (97 %)", of the cause with the largest share.
std::string largest(const Estimate& e, double (*share)(const BudgetLine&, const Estimate&)) {
  const auto at = std::max_element(
      e.budget.begin(), e.budget.end(),
      [&](const BudgetLine& a, const BudgetLine& b) { return share(a, e) < share(b, e); });
  return fmt::format("{} ({:.0f} %)", at->cause, 100.0 * share(*at, e));
}

Html meter(double share) {
  return Html{fmt::format("<meter min=\"0\" max=\"1\" value=\"{:.4f}\">{:.0f} %</meter>", share,
                          100.0 * share)};
}

}  // namespace

Html budget_details(char channel, const Estimate& e) {
  if (e.budget.empty() || !e.converged) return {};
  std::vector<BudgetLine> lines = e.budget;
  std::stable_sort(lines.begin(), lines.end(), [&](const BudgetLine& a, const BudgetLine& b) {
    return std::max(share_of_s(a, e), share_of_a(a, e)) >
           std::max(share_of_s(b, e), share_of_a(b, e));
  });
  HtmlTable table;
  table.header = {"cause", "sigma_s' [1/mm]", "share", "sigma_a [1/mm]", "share"};
  for (const BudgetLine& line : lines) {
    table.rows.push_back({text_cell(line.cause),
                          number_cell(fmt::format("{:.2g}", line.std_sigma_s_prime_per_mm)),
                          {meter(share_of_s(line, e)), false, ""},
                          number_cell(fmt::format("{:.2g}", line.std_sigma_a_per_mm)),
                          {meter(share_of_a(line, e)), false, ""}});
  }
  return html_details(
      fmt::format("{}: the uncertainty of sigma_s' is mainly due to {}, that of sigma_a to {}",
                  channel, largest(e, share_of_s), largest(e, share_of_a)),
      html_table(table));
}

}  // namespace scattermeter::apps
