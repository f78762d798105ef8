// Opening one of a scene's shots.
#pragma once

#include <string>

#include "capture/raw/raw_frame.h"
#include "capture/shots/shot_decoding.h"
#include "core/scene/scene.h"

namespace scattermeter::capture {

// Decodes the file and holds it against the scene: camera model (make and model, case ignored),
// size of the active area, an exposure time. Throws InputError naming file, field and both values.
RawFrame open_shot(const Scene& scene, const ShotDecoding& decoding, const std::string& path);

}  // namespace scattermeter::capture
