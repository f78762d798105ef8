// What a decoded shot was made from, as a name.
#pragma once

#include <string>
#include <vector>

#include "apps/digest.h"
#include "apps/shot_system.h"

namespace scattermeter::apps {

// The same for two shots if and only if decoding them gives the same (apps/decoded_shot.h): the
// contents of their files, what the rig says of the camera, and which samples fall on which patch,
// by all that decides it (pose, lens, mesh, patch size, eta). What the rig says of lights and
// materials has no part in it. names: of the shot's files, paths. Precondition: the pose does not
// come from the shot itself. Throws InputError naming a file that cannot be read.
std::string shot_key(const Rig& rig, const OpenedShot& shot, const std::vector<std::string>& names,
                     FileDigests& digests);

}  // namespace scattermeter::apps
