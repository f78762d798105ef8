// The file written by `calibrate radiance` and named by a rig's camera.radiance.
#pragma once

#include <string>

#include "capture/sensor/radiance_calibration.h"

namespace scattermeter::apps {

// YAML, with all digits that are needed to read back the same doubles.
std::string radiance_file_text(const capture::RadianceCalibration& calibration);

// Throws InputError with file, line, field and value.
capture::RadianceCalibration read_radiance_file(const std::string& path);

}  // namespace scattermeter::apps
