// Writing of result.json.
#pragma once

#include <string>

#include "apps/instrument/measure.h"

namespace scattermeter::apps {

// The `$id` of result.schema.json, which every result names as its `$schema`: a name and no place,
// so that it is the same wherever the program is installed.
inline constexpr const char* kResultSchema = "urn:scattermeter:result:1";

// The measurement as JSON text: `$schema`, `results`, one entry per material and channel, then
// patch sizes, notes, timing, version, command and the inputs with their digests. Numbers that are
// not finite or unknown become null.
std::string result_json(const Measurement& measurement, const std::string& command_line = {});

}  // namespace scattermeter::apps
