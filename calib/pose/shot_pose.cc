#include "calib/pose/shot_pose.h"

#include <filesystem>
#include <stdexcept>
#include <variant>

#include <fmt/core.h>

#include "calib/board/grey_picture.h"
#include "calib/pose/lens_reaction.h"
#include "calib/pose/silhouette.h"
#include "calib/pose/silhouette_check.h"
#include "calib/pose/silhouette_pose.h"
#include "capture/files/file_kind.h"
#include "capture/shots/raw_shot.h"
#include "core/base/input_error.h"

namespace scattermeter::calib {

PoseResult pose_from_points(const Scene& scene, const PoseSource& source) {
  PoseResult pose = estimate_pose(scene.camera.intrinsics, source.points, source.options);
  if (pose.status != PoseStatus::kOk) {
    throw InputError(scene.at(source.line) + ": pose.points", pose.message);
  }
  return pose;
}

std::string left_out_points(const PoseResult& pose) {
  std::string out;
  for (std::size_t i = 0; i < pose.inlier.size(); ++i) {
    if (pose.inlier[i]) continue;
    out += fmt::format("{}points[{}]", out.empty() ? "" : ", ", i);
    if (i < pose.residuals_px.size()) {
      out += fmt::format(" ({:.3g} px off)", pose.residuals_px[i].norm());
    }
  }
  return out;
}

namespace {

std::vector<PointPair> board_corners(const CharucoBoard& board, const capture::RawFrame& frame,
                                     const std::string& path) {
  const GreyPicture grey = grey_picture(frame);
  std::vector<PointPair> corners = find_charuco_corners(
      board, grey.grey, grey.width_px, grey.height_px, grey.px_scale, grey.px_offset);
  if (corners.empty())
    throw InputError(path,
                     "pose.charuco: the board is not seen in this shot: see that it is "
                     "whole and sharp, and that dictionary and squares are its own");
  return corners;
}

}  // namespace

PoseResult pose_from_board(const Scene& scene, const PoseSource& source,
                           const capture::RawFrame& frame, const std::string& path) {
  const std::vector<PointPair> corners = board_corners(*source.charuco, frame, path);
  PoseResult pose = estimate_pose(scene.camera.intrinsics, corners, source.options);
  if (pose.status != PoseStatus::kOk) {
    const CharucoBoard& board = *source.charuco;
    throw InputError(
        path,
        fmt::format("pose.charuco: {} of {} corners of the board are found, and do not "
                    "determine the pose: {}; see that the board is large and sharp in the "
                    "picture, and that squares (not inner corners) and dictionary are its own",
                    corners.size(), (board.squares_x - 1) * (board.squares_y - 1), pose.message));
  }
  return pose;
}

void take_points_from_board_shot(const Scene& scene, const capture::ShotDecoding& decoding,
                                 const std::string& shots_folder, PoseSource& source) {
  if (!source.charuco || source.board_shot.empty()) return;
  const std::string path = (std::filesystem::path(shots_folder) / source.board_shot).string();
  if (!capture::is_there(path)) {
    throw InputError(scene.at(source.line) + ": pose.shot",
                     "is not in the folder " + shots_folder + ": " + source.board_shot);
  }
  take_points_from_board_shot(capture::open_shot(scene, decoding, path), path, source);
}

void take_points_from_board_shot(const capture::RawFrame& frame, const std::string& name,
                                 PoseSource& source) {
  source.points = board_corners(*source.charuco, frame, name);
  source.charuco.reset();
}

namespace {

PoseResult refined(const Scene& scene, const PoseSource& source, const PoseResult& prior,
                   const std::vector<EdgeShot>& shots, const std::string& name) {
  SilhouetteOptions options;
  options.line_std_px = source.edge_std_px;
  options.pose_is_near = source.charuco.has_value();
  const std::string where = scene.at(source.line) + ": pose.refine";
  Silhouette silhouette =
      find_silhouette(shots, scene.camera.intrinsics, prior.camera_from_world, options);
  if (silhouette.status != SilhouetteStatus::kOk) {
    throw InputError(where, name + ": " + silhouette.message);
  }
  PoseResult pose = combine(silhouette, scene.camera.intrinsics, prior);
  if (pose.status == PoseStatus::kNoConsensus) {
    if (auto others = without_strays(silhouette)) {
      silhouette = std::move(*others);
      pose = combine(silhouette, scene.camera.intrinsics, prior);
    }
  }
  if (pose.status != PoseStatus::kOk) throw InputError(where, name + ": " + pose.message);
  pose.per_lens_parameter = combined_per_lens_parameter(silhouette, scene.camera.intrinsics, prior,
                                                        scene.camera.lens_root.rowwise().norm());
  return pose;
}

}  // namespace

PoseResult pose_from_silhouette(const Scene& scene, const PoseSource& source,
                                const ObjectScenes& objects, const PoseResult& prior,
                                std::size_t shot_idx, const capture::RawFrame& frame,
                                const std::string& name) {
  SilhouetteOptions options;
  options.line_std_px = source.edge_std_px;
  return refined(scene, source, prior,
                 {edge_shot(scene, source, objects, scene.shots.at(shot_idx), frame,
                            prior.camera_from_world, options)},
                 name);
}

PoseResult pose_from_silhouettes(const Scene& scene, const PoseSource& source,
                                 const ObjectScenes& objects, const PoseResult& prior,
                                 const capture::ShotSource& shots) {
  const capture::FrameSource* frames = std::get_if<capture::FrameSource>(&shots.open);
  if (frames == nullptr) {
    throw std::invalid_argument("pose_from_silhouettes: samples of an object need a pose first");
  }
  SilhouetteOptions options;
  options.line_std_px = source.edge_std_px;
  std::vector<EdgeShot> edges;
  for (const std::size_t idx : shots.shot_idxs) {
    edges.push_back(edge_shot(scene, source, objects, scene.shots.at(idx), (*frames)(idx, 0),
                              prior.camera_from_world, options));
  }
  return refined(scene, source, prior, edges, shots.names.at(0).at(0));
}

}  // namespace scattermeter::calib
