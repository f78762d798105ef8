// The paper's simulated shot: a pyramid of known material under a light probe.
#pragma once

#include <memory>

#include "apps/rig/open_objects.h"
#include "apps/rig/rig.h"
#include "core/light/environment.h"

namespace scattermeter::apps {

// One shot, "pyramid.dng", of pyramid_mesh() (core/mesh/bodies.h) of material "pyramid",
// sigma_s' 2.19 and sigma_a 0.002 per mm in each channel, eta 1.3, lit by `probe` (its projection
// and rotation count) of which a value of 1 is 1 W/(mm^2 sr), by the camera of
// apps/simulation/synthetic_camera.h. Everything is exactly known; the exposure is chosen.
// Throws std::invalid_argument unless probe is given and 240 <= image_width_px <= 3872.
Rig pyramid_rig(int image_width_px, std::shared_ptr<const Environment> probe);

// Its object.
ObjectScenes pyramid_scenes(const Rig& rig);

}  // namespace scattermeter::apps
