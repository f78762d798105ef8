// Search for a second pose that explains the same points.
#pragma once

#include <optional>
#include <vector>

#include "calib/pose/pose_refine.h"

namespace scattermeter::calib {

// The best local optimum over the pairs whose `use` is set that differs from `first` by more than
// three standard deviations (of `first`, with noise_std_px); none if every start leads back to
// `first`. It may fit better than `first`.
//
// Points in or near one plane, in a region small compared with its distance, look the same when the
// tilt of the plane is reversed (Necker's reversal; D. Oberkampf, D. DeMenthon, L. Davis,
// "Iterative pose estimation using coplanar feature points", 1996): that reversed pose is one
// start. The others, for up to six pairs, are all exact poses of three of them.
std::optional<PoseFit> second_pose(const PoseScene& scene, const std::vector<bool>& use,
                                   const PoseFit& first, double noise_std_px);

}  // namespace scattermeter::calib
