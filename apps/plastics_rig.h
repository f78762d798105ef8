// A rig made in code: three plastics, two shapes, two LEDs, and nothing to read from disk.
#pragma once

#include "apps/object_scene.h"
#include "apps/rig.h"

namespace scattermeter::apps {

// Twelve shots as of the paper's table 3 of a cube and a pyramid on a pedestal (apps/bodies.h), by
// the camera of apps/studio.h. Scale, LEDs and eta are exact. An exposure is given that clips
// nothing. Precondition (std::invalid_argument): 240 <= image_width_px <= 3872.
Rig plastics_rig(int image_width_px);

// Its objects.
ObjectScenes plastics_scenes(const Rig& rig);

}  // namespace scattermeter::apps
