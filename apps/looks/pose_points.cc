#include "apps/looks/pose_points.h"

#include <algorithm>

#include <fmt/core.h>

#include "core/base/chi_square.h"

namespace scattermeter::apps {

std::optional<Finding> scattered_points(const Rig& rig, const PoseResult& pose,
                                        const std::vector<std::size_t>& shots) {
  constexpr double kMostRatio = 2.0;
  constexpr double kLeastProbability = 1e-6;
  const double stated_px = rig.pose.options.point_std_px;
  const double dof =
      2.0 * static_cast<double>(std::count(pose.inlier.begin(), pose.inlier.end(), true)) - 6.0;
  const double ratio = pose.noise_std_px / stated_px;
  if (!(ratio > kMostRatio) || chi_square_tail(dof * ratio * ratio, dof) > kLeastProbability) {
    return std::nullopt;
  }
  return Finding{"pose points",
                 fmt::format("pose points scatter by {:.2g} px about the best camera pose, {:.1f} "
                             "times the {:.2g} px of pose.point_std_px",
                             pose.noise_std_px, ratio, stated_px),
                 "check camera.intrinsics (was the lens focused again?) and the marks' positions, "
                 "or state how well they were read",
                 shots};
}

}  // namespace scattermeter::apps
