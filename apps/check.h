// Does the rig hold? The residual of every calibration against its limit.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "apps/check_item.h"
#include "apps/checked_rig.h"
#include "apps/rig.h"

namespace scattermeter::apps {

struct CheckReport {
  std::vector<CheckItem> items;
  std::vector<std::string> notes;
  bool passed() const;
};

// A station looks at one thing. None of them reads a file.
using CheckStation = std::function<std::vector<CheckItem>(const CheckedRig&)>;

// All of them, in the order of the report. What is new to be checked joins this list.
const std::vector<CheckStation>& check_stations();

// Every station on the rig's shots.
CheckReport check_report(const CheckedRig& checked);

// One line an item.
std::string check_table(const CheckReport& report);
// check.json: every item with its details.
std::string check_json(const CheckReport& report, const std::string& command_line);

}  // namespace scattermeter::apps
