// A rig made in code: three plastics, two shapes, two LEDs, and nothing to read from disk.
#pragma once

#include "apps/object_scene.h"
#include "apps/rig.h"
#include "core/triangle_mesh.h"

namespace scattermeter::apps {

// A 20 mm cube on z = 0, and a square pyramid (base 16 mm, height 13 mm) on a pedestal of 22 x 22 x
// 7 mm: closed, centred on the z axis.
TriangleMesh cube_mesh();
TriangleMesh pyramid_on_pedestal_mesh();

// Twelve shots as of the paper's table 3, by a camera of a D80's noise and frame, at
// `image_width_px` (even; the frame is 3 : 2 and about 61 mm wide at the object whatever the
// width). The pose points are exact and known to 0.001 px, scale, LEDs and eta are exact. An
// exposure is given that clips nothing. Precondition (std::invalid_argument): 240 <= image_width_px
// <= 3872.
Rig plastics_rig(int image_width_px);

// Its objects.
ObjectScenes plastics_scenes(const Rig& rig);

}  // namespace scattermeter::apps
