// A rig's calibration.radiance: dark frames, flats, exposure series, white reference, brackets,
// glare.
#pragma once

#include <string>

#include "apps/yaml_field.h"

namespace scattermeter::apps {

struct RigRadianceCalibration {};

// Throws InputError with file, line, field and value.
RigRadianceCalibration read_radiance_calibration(const YamlField& field,
                                                 const std::string& rig_path);

}  // namespace scattermeter::apps
