// Opening of the shots of a scene.
#pragma once

#include <string>

#include "capture/raw/raw_frame.h"
#include "capture/shots/shot_decoding.h"
#include "core/scene/scene.h"

namespace scattermeter::capture {

// Decodes the file and checks it against the scene: camera model (make and model, case ignored),
// size of the active area, presence of an exposure time. Defects that the calibration lists are
// mended. Throws InputError naming the file, the field and both values.
RawFrame open_shot(const Scene& scene, const ShotDecoding& decoding, const std::string& path);

}  // namespace scattermeter::capture
