// The paper's twelve shots as a rig made in code, with nothing to read from disk.
#pragma once

#include "apps/rig/rig.h"

namespace scattermeter::apps {

// PP, PE and POM as of the paper's table 3 in bodies_rig() (whose bodies_scenes() are its objects),
// eta 1.49, all exact; a given exposure that clips nothing. Precondition (std::invalid_argument):
// 240 <= image_width_px <= 3872.
Rig plastics_rig(int image_width_px);

}  // namespace scattermeter::apps
