// Where the shots show that an object stands.
#pragma once

#include <limits>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "core/camera/pose_shift.h"
#include "core/fit/prior_pulls.h"
#include "core/scene/observed_shot.h"
#include "core/scene/scene.h"

namespace scattermeter {

// The offset of a quantity, at most that at a pull of three: a fit that does not describe its image
// yet may explain it by a lens that no one has.
double believable(const PriorPull& pull);

// The shift of the shot's pose relative to its object by the most probable values of pose, lens,
// position and size of the object (`pulls`: those of all channels together; a quantity that is not
// among them keeps its stated value). A change of the lens counts as that shift of the pose which
// is nearest to it on the object.
PoseShift most_probable_shift(const Scene& scene, const ObservedShot& shot,
                              const std::vector<PriorPull>& pulls);

// A motion of the object against the view of its shots (rms, across the line of sight), as a share
// of a patch, beyond which the derivatives by pose and position no longer describe the image
// exactly enough: it is to be seen from elsewhere.
inline constexpr double kVisibleMotion = 0.02;

// The same of the shot's sites when its pose shifts, in patches.
double motion_in_patches(const ObservedShot& shot, const PoseShift& by);

struct SeenElsewhere {
  double motion = 0;                        // of the view that moves most, in patches
  std::map<std::string, PoseShift> shifts;  // by ObservedShot::view_name(): for the next views
};

// Whether the images determine that they were taken from elsewhere: a quantity by which the view
// moves is off by more than 2.5 of its deviations, prior and images together.
bool is_determined_elsewhere(const std::vector<PriorPull>& joint_pulls);

// Where the shots show the objects to lie, against their views, by the pulls of all channels
// together. The next view goes the whole way, or half of it where the last one (its motion:
// motion_before, in patches) did not come nearer. Nothing without pulls.
SeenElsewhere seen_elsewhere(const Scene& scene, std::span<const ObservedShot> shots,
                             const std::vector<PriorPull>& pulls,
                             double motion_before = std::numeric_limits<double>::infinity());

// As many views are tried; an object that has not settled in them does not.
inline constexpr int kMostViews = 8;

}  // namespace scattermeter
