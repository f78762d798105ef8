// A rig made in code: bodies of any materials under two LEDs.
#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "apps/rig/open_objects.h"
#include "apps/rig/rig.h"
#include "core/material/medium.h"

namespace scattermeter::apps {

// A name and R, G, B (eta is not used).
using NamedMedia = std::pair<std::string, std::array<Medium, 3>>;

// Two shots per material and body (names of core/mesh/bodies.h), "<name>_cube_1.dng" ...
// "<name>_pyramid_2.dng", under one LED and then the other, by the camera of set_up_camera()
// (apps/simulation/synthetic_camera.h). Everything except the pose points is exactly known; one
// exposure is chosen for all shots. Throws std::invalid_argument unless 240 <= image_width_px <=
// 3872.
Rig bodies_rig(int image_width_px, double eta_int_over_ext,
               const std::vector<NamedMedia>& materials,
               const std::vector<std::string>& bodies = {"cube", "pyramid"});

// Its objects. Throws std::invalid_argument for an object that is not one of the bodies.
ObjectScenes bodies_scenes(const Rig& rig);

}  // namespace scattermeter::apps
