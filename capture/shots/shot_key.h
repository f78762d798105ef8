// Key of a decoded shot: a name for everything that it was made from.
#pragma once

#include <string>
#include <vector>

#include "capture/files/digest.h"
#include "capture/shots/shot_decoding.h"
#include "core/scene/observed_shot.h"

namespace scattermeter::capture {

// Two shots have the same key if and only if everything that their decoding
// (capture/shots/decoded_shot.h) depends on is the same: the contents of their files, the rig's
// data on the camera, and all that determines which samples fall on which patch (pose, lens, mesh,
// patch size, eta). The rig's lights and materials do not matter. names: the paths of the shot's
// files. Precondition: the pose is not estimated from the shot itself. Throws InputError naming a
// file that cannot be read.
std::string shot_key(const Scene& scene, const ShotDecoding& decoding, const ObservedShot& shot,
                     const std::vector<std::string>& names, FileDigests& digests);

}  // namespace scattermeter::capture
