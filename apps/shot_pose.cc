#include "apps/shot_pose.h"

#include <filesystem>
#include <stdexcept>
#include <variant>

#include <fmt/core.h>

#include "apps/file_kind.h"
#include "apps/grey_picture.h"
#include "apps/raw_shot.h"
#include "apps/rig_lens.h"
#include "apps/silhouette_check.h"
#include "calib/lens_reaction.h"
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

namespace {

std::vector<calib::PointPair> board_corners(const calib::CharucoBoard& board,
                                            const capture::RawFrame& frame,
                                            const std::string& path) {
  const GreyPicture grey = grey_picture(frame);
  std::vector<calib::PointPair> corners = calib::find_charuco_corners(
      board, grey.grey, grey.width_px, grey.height_px, grey.px_scale, grey.px_offset);
  if (corners.empty()) throw InputError(path, "pose.charuco: the board is not seen in this shot");
  return corners;
}

}  // namespace

calib::PoseResult pose_from_board(const Rig& rig, const capture::RawFrame& frame,
                                  const std::string& path) {
  const std::vector<calib::PointPair> corners = board_corners(*rig.pose.charuco, frame, path);
  calib::PoseResult pose = calib::estimate_pose(rig.camera.intrinsics, corners, rig.pose.options);
  if (pose.status != calib::PoseStatus::kOk) {
    throw InputError(
        path, fmt::format("pose.charuco: {} corners found: {}", corners.size(), pose.message));
  }
  return pose;
}

void take_points_from_board_shot(const std::string& shots_folder, Rig& rig) {
  if (!rig.pose.charuco || rig.pose.board_shot.empty()) return;
  const std::string path = (std::filesystem::path(shots_folder) / rig.pose.board_shot).string();
  if (!is_there(path)) {
    throw InputError(rig.at(rig.pose.line) + ": pose.shot",
                     "is not in the folder " + shots_folder + ": " + rig.pose.board_shot);
  }
  take_points_from_board_shot(open_shot(rig, path), path, rig);
}

void take_points_from_board_shot(const capture::RawFrame& frame, const std::string& name,
                                 Rig& rig) {
  rig.pose.points = board_corners(*rig.pose.charuco, frame, name);
  rig.pose.charuco.reset();
}

namespace {

calib::PoseResult refined(const Rig& rig, const calib::PoseResult& prior,
                          const std::vector<calib::EdgeShot>& shots, const std::string& name) {
  calib::SilhouetteOptions options;
  options.line_std_px = rig.pose.edge_std_px;
  options.pose_is_near = rig.pose.charuco.has_value();
  const std::string where = rig.at(rig.pose.line) + ": pose.refine";
  const calib::Silhouette silhouette =
      calib::find_silhouette(shots, rig.camera.intrinsics, prior.camera_from_world, options);
  if (silhouette.status != calib::SilhouetteStatus::kOk) {
    throw InputError(where, name + ": " + silhouette.message);
  }
  calib::PoseResult pose = calib::combine(silhouette, rig.camera.intrinsics, prior);
  if (pose.status != calib::PoseStatus::kOk) throw InputError(where, name + ": " + pose.message);
  pose.per_lens_parameter = calib::combined_per_lens_parameter(
      silhouette, rig.camera.intrinsics, prior, lens_root(rig.camera).rowwise().norm());
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
    shots.push_back(edge_shot(rig, scenes, rig.shots.at(idx), (*frames)(idx, 0),
                              prior.camera_from_world, options));
  }
  return refined(rig, prior, shots, source.names.at(0).at(0));
}

}  // namespace scattermeter::apps
