#include "apps/shot_pose.h"

#include <algorithm>

#include <fmt/core.h>

#include "core/input_error.h"

namespace scattermeter::apps {

calib::PoseResult pose_from_points(const Rig& rig) {
  calib::PoseResult pose =
      calib::estimate_pose(rig.camera.intrinsics, rig.pose.points, rig.pose.options);
  if (pose.status != calib::PoseStatus::kOk) {
    throw InputError(rig.at(rig.pose.line) + ": pose.points", pose.message);
  }
  return pose;
}

calib::PoseResult pose_from_board(const Rig& rig, const capture::RawFrame& frame,
                                  const std::string& path) {
  // One grey pixel per 2 x 2 cell, the mean of its samples above black: any filter phase, no
  // interpolation, corners displaced by no more than the cell's own centre (0.5, 0.5).
  const int width = frame.width_px / 2;
  const int height = frame.height_px / 2;
  std::vector<float> grey(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  double black = 0.0;
  for (double b : frame.black_counts) black += 0.25 * b;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const int sum = frame.at(2 * x, 2 * y) + frame.at(2 * x + 1, 2 * y) +
                      frame.at(2 * x, 2 * y + 1) + frame.at(2 * x + 1, 2 * y + 1);
      grey[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(x)] = static_cast<float>(std::max(0.0, 0.25 * sum - black));
    }
  }
  const std::vector<calib::PointPair> corners =
      calib::find_charuco_corners(*rig.pose.charuco, grey, width, height, 2.0, 0.5);
  if (corners.empty()) throw InputError(path, "pose.charuco: the board is not seen in this shot");
  calib::PoseResult pose = calib::estimate_pose(rig.camera.intrinsics, corners, rig.pose.options);
  if (pose.status != calib::PoseStatus::kOk) {
    throw InputError(
        path, fmt::format("pose.charuco: {} corners found: {}", corners.size(), pose.message));
  }
  return pose;
}

}  // namespace scattermeter::apps
