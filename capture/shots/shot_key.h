// What a decoded shot was made from, as a name.
#pragma once

#include <string>
#include <vector>

#include "capture/files/digest.h"
#include "capture/shots/shot_decoding.h"
#include "core/scene/observed_shot.h"

namespace scattermeter::capture {

// The same for two shots if and only if decoding them gives the same
// (capture/shots/decoded_shot.h): the contents of their files, what the rig says of the camera, and
// which samples fall on which patch, by all that decides it (pose, lens, mesh, patch size, eta).
// What the rig says of lights and materials has no part in it. names: of the shot's files, paths.
// Precondition: the pose does not come from the shot itself. Throws InputError naming a file that
// cannot be read.
std::string shot_key(const Scene& scene, const ShotDecoding& decoding, const ObservedShot& shot,
                     const std::vector<std::string>& names, FileDigests& digests);

}  // namespace scattermeter::capture
