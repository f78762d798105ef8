#include "apps/report/check_json.h"

#include <cmath>

#include <nlohmann/json.hpp>

#include "core/base/version.h"

namespace scattermeter::apps {
namespace {

using CheckJson = nlohmann::ordered_json;

CheckJson or_null(double value) {
  return std::isfinite(value) ? CheckJson(value) : CheckJson(nullptr);
}

}  // namespace

std::string check_json(const CheckReport& report, const std::string& command_line) {
  CheckJson j;
  j["passed"] = report.passed();
  j["most_probable_cause"] = report.cause;
  j["checks"] = CheckJson::array();
  for (const CheckItem& item : report.items) {
    CheckJson details = CheckJson::array();
    for (const CheckDetail& d : item.details) {
      details.push_back({{"where", d.where}, {"value", or_null(d.value)}, {"std", or_null(d.std)}});
    }
    j["checks"].push_back({{"check", item.what},
                           {"rms", or_null(item.rms)},
                           {"worst", or_null(item.worst)},
                           {"limit", or_null(item.limit)},
                           {"limit_is", item.at_least ? "least" : "most"},
                           {"unit", item.unit},
                           {"worst_at", item.where},
                           {"verdict", item.details.empty() ? "not judged"
                                       : item.passed        ? "pass"
                                                            : "fail"},
                           {"advice", item.advice},
                           {"details", details}});
  }
  j["notes"] = report.notes;
  j["version"] = kVersion;
  j["command"] = command_line;
  // File names may contain bytes that are not UTF-8; these are replaced.
  return j.dump(2, ' ', false, CheckJson::error_handler_t::replace) + "\n";
}

}  // namespace scattermeter::apps
