#include "apps/report/check_table.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "apps/report/text_table.h"

namespace scattermeter::apps {
namespace {

std::string short_number(double value) {
  return std::isfinite(value) ? fmt::format("{:.3g}", value) : "-";
}

}  // namespace

std::string check_table(const CheckReport& report) {
  using Align = TextTable::Align;
  TextTable table({{"check", Align::kLeft},
                   {"rms"},
                   {"worst"},
                   {"limit"},
                   {"unit", Align::kLeft},
                   {"verdict", Align::kLeft},
                   {"worst at", Align::kLeft}});
  std::string advice;
  for (const CheckItem& item : report.items) {
    const bool judged = !item.details.empty();
    table.add_row({item.what, short_number(item.rms), short_number(item.worst),
                   fmt::format("{}{:.3g}", item.at_least ? ">= " : "", item.limit), item.unit,
                   !judged       ? "-"
                   : item.passed ? "pass"
                                 : "FAIL",
                   item.where});
    if (!item.passed) {
      advice += fmt::format("FAIL {}: {}: {}\n", item.what, item.where, item.advice);
    }
  }
  std::string out;
  if (!report.cause.empty()) {
    out = "most probable cause: " + report.cause + "\n" + "the failures below may follow from it\n";
  }
  out += table.text() + advice;
  for (const std::string& note : report.notes) out += "note: " + note + "\n";
  const auto failed = std::count_if(report.items.begin(), report.items.end(),
                                    [](const CheckItem& i) { return !i.passed; });
  out += failed == 0 ? fmt::format("all {} checks passed\n", report.items.size())
                     : fmt::format("{} of {} checks FAILED\n", failed, report.items.size());
  return out;
}

}  // namespace scattermeter::apps
