// The paper's twelve shots as a rig made in code, with nothing to read from disk.
#pragma once

#include "apps/rig/rig.h"

namespace scattermeter::apps {

// bodies_rig() with PP, PE and POM of the paper's table 3, eta 1.49, exactly known, and a fixed
// exposure that clips nothing; its objects are those of bodies_scenes(). Throws
// std::invalid_argument unless 240 <= image_width_px <= 3872.
Rig plastics_rig(int image_width_px);

}  // namespace scattermeter::apps
