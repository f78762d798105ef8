// Reading of a rig's calibration.radiance: dark frames, flats, white reference and glare.
#pragma once

#include <string>

#include "apps/rig/yaml_field.h"
#include "calib/radiance/radiance_calibration_shots.h"

namespace scattermeter::apps {

// Throws InputError with file, line, field and value. Does not check that white.light is a light
// of the rig.
calib::RadianceCalibrationShots read_radiance_calibration(const YamlField& field,
                                                          const std::string& rig_path);

}  // namespace scattermeter::apps
