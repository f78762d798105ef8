// Where the shots show that an object stands.
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "core/camera/pose_shift.h"
#include "core/fit/prior_pulls.h"
#include "core/scene/observed_shot.h"
#include "core/scene/scene.h"

namespace scattermeter {

// The shift of the shot's pose relative to its object by the most probable values of pose, lens,
// position and size of the object (`pulls`: those of all channels together; a quantity that is not
// among them keeps its stated value). A change of the lens counts as that shift of the pose which
// is nearest to it on the object. Precondition: the pose is common to all shots.
PoseShift most_probable_shift(const Scene& scene, const ObservedShot& shot,
                              const std::vector<PriorPull>& pulls);

// By object, the shifts of the views from where the shots show the objects to stand, if one of them
// moves an object visibly against the view of its shots: by 0.02 of a patch (rms, across the line
// of sight). There the derivatives by pose and position no longer describe the image exactly
// enough. pulls: of all channels together. Empty otherwise, without pulls, and for shots with poses
// of their own.
std::map<std::string, PoseShift> visible_shifts(const Scene& scene,
                                                std::span<const ObservedShot> shots,
                                                const std::vector<PriorPull>& pulls);

}  // namespace scattermeter
