// Opening one of the rig's shots.
#pragma once

#include <string>

#include "apps/rig.h"
#include "capture/raw_frame.h"

namespace scattermeter::apps {

// "NIKON D80", "Nikon D80" and "D80" are one camera: LibRaw shortens makes and strips them from
// models.
bool same_camera(const std::string& wanted, const std::string& make, const std::string& model);

// Decodes the file and holds it against the rig: camera model (make and model, case ignored), size
// of the active area, an exposure time. Throws InputError naming file, field and both values.
capture::RawFrame open_shot(const Rig& rig, const std::string& path);

}  // namespace scattermeter::apps
