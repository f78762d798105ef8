// Writing of result.json.
#pragma once

#include <string>

#include "apps/instrument/measure.h"

namespace scattermeter::apps {

// The measurement as JSON text: `results`, one entry per material and channel, then patch sizes,
// notes, timing, version, command and the inputs with their digests. Numbers that are not finite or
// unknown become null.
std::string result_json(const Measurement& measurement, const std::string& command_line = {});

}  // namespace scattermeter::apps
