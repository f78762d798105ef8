// The file that `calibrate radiance` writes and a rig's camera.radiance names.
#pragma once

#include <string>

#include "capture/sensor/radiance_calibration.h"

namespace scattermeter::apps {

// YAML, every number with the digits that a double needs to come back.
std::string radiance_file_text(const capture::RadianceCalibration& calibration);

// Throws InputError with file, line, field and value.
capture::RadianceCalibration read_radiance_file(const std::string& path);

}  // namespace scattermeter::apps
