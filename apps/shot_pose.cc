#include "apps/shot_pose.h"

#include <algorithm>
#include <stdexcept>
#include <variant>

#include <fmt/core.h>

#include "apps/silhouette_check.h"
#include "calib/silhouette.h"
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

namespace {

calib::PoseResult refined(const Rig& rig, const calib::PoseResult& prior,
                          const std::vector<calib::EdgeShot>& shots, const std::string& name) {
  calib::SilhouetteOptions options;
  options.line_std_px = rig.pose.edge_std_px;
  const std::string where = rig.at(rig.pose.line) + ": pose.refine";
  const calib::Silhouette silhouette =
      calib::find_silhouette(shots, rig.camera.intrinsics, prior.camera_from_world, options);
  if (silhouette.status != calib::SilhouetteStatus::kOk) {
    throw InputError(where, name + ": " + silhouette.message);
  }
  calib::PoseResult pose = calib::combine(silhouette, rig.camera.intrinsics, prior);
  if (pose.status != calib::PoseStatus::kOk) throw InputError(where, name + ": " + pose.message);
  return pose;
}

}  // namespace

calib::PoseResult pose_from_silhouette(const Rig& rig, const ObjectScenes& scenes,
                                       const calib::PoseResult& prior, std::size_t shot_idx,
                                       const capture::RawFrame& frame, const std::string& name) {
  calib::SilhouetteOptions options;
  options.line_std_px = rig.pose.edge_std_px;
  return refined(
      rig, prior,
      {edge_shot(rig, scenes, rig.shots.at(shot_idx), frame, prior.camera_from_world, options)},
      name);
}

calib::PoseResult pose_from_silhouettes(const Rig& rig, const ObjectScenes& scenes,
                                        const calib::PoseResult& prior, const ShotSource& source) {
  const FrameSource* frames = std::get_if<FrameSource>(&source.open);
  if (frames == nullptr) {
    throw std::invalid_argument("pose_from_silhouettes: samples of an object need a pose first");
  }
  calib::SilhouetteOptions options;
  options.line_std_px = rig.pose.edge_std_px;
  std::vector<calib::EdgeShot> shots;
  for (const std::size_t idx : source.shot_idxs) {
    shots.push_back(edge_shot(rig, scenes, rig.shots.at(idx), (*frames)(idx),
                              prior.camera_from_world, options));
  }
  return refined(rig, prior, shots, source.names.at(0));
}

}  // namespace scattermeter::apps
