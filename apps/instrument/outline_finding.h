// The words for what the outlines of the objects contradict.
#pragma once

#include <string>

#include "apps/instrument/finding.h"
#include "calib/pose/outline_causes.h"

namespace scattermeter::apps {

// Of a diagnosis that does not agree: its most probable cause with those that cannot be told from
// it, and the next step; without shots. object: the one whose mesh is in question; "": none.
Finding outline_finding(const calib::OutlineDiagnosis& diagnosis, const std::string& object);

}  // namespace scattermeter::apps
