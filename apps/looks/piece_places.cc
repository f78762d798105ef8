#include "apps/looks/piece_places.h"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <utility>

#include <fmt/format.h>

#include "apps/looks/moved_piece.h"
#include "apps/looks/piece_look.h"
#include "apps/rig/open_objects.h"
#include "calib/pose/piece_pose.h"
#include "calib/pose/shot_pose.h"
#include "calib/pose/silhouette_check.h"
#include "capture/files/file_kind.h"
#include "capture/shots/raw_shot.h"
#include "core/base/input_error.h"

namespace scattermeter::apps {
namespace {

std::vector<calib::PieceView> views_of(const Rig& rig, const ObjectScenes& objects,
                                       const std::vector<const SceneShot*>& shots,
                                       const std::string& folder,
                                       const calib::SilhouetteOptions& options) {
  std::vector<calib::PieceView> views;
  if (!rig.pose.charuco) views.push_back({calib::pose_from_points(rig.scene, rig.pose), {}});
  for (const SceneShot* shot : shots) {
    const std::string path = (std::filesystem::path(folder) / shot->file).string();
    if (!capture::is_there(path)) {
      throw InputError(rig.at(shot->line),
                       "shot is not in the folder " + folder + ": " + shot->file);
    }
    const capture::RawFrame frame = capture::open_shot(rig.scene, rig.decoding, path);
    if (rig.pose.charuco) {
      views.push_back({calib::pose_from_board(rig.scene, rig.pose, frame, path), {}});
    }
    views.back().shots.push_back(calib::edge_shot(rig.scene, rig.pose, objects, *shot, frame,
                                                  views.back().camera.camera_from_world, options));
  }
  return views;
}

}  // namespace

std::vector<std::string> place_pieces(Rig& rig, const std::string& shots_folder,
                                      Progress* progress) {
  std::vector<std::string> out;
  const auto is_wanted = [](const SceneObject& o) { return o.to_be_found.has_value(); };
  const auto n = static_cast<std::size_t>(
      std::count_if(rig.scene.objects.begin(), rig.scene.objects.end(), is_wanted));
  if (n == 0) return out;
  ProgressStage stage(progress, "finding the pieces", n);
  const ObjectScenes objects = open_objects(rig);
  for (SceneObject& object : rig.scene.objects) {
    std::vector<const SceneShot*> shots;
    for (const std::size_t idx : telling_shots(rig.scene.shots, object.name)) {
      shots.push_back(&rig.scene.shots[idx]);
    }
    if (!is_wanted(object) || shots.empty()) continue;
    calib::PiecePoseOptions options = piece_pose_options(rig, objects.at(object.name));
    options.is_on_plane = object.to_be_found->is_on_plane;
    const calib::PiecePose found = calib::find_piece(
        views_of(rig, objects, shots, shots_folder, options.silhouette),
        rig.scene.camera.intrinsics, objects.at(object.name).box.center_mm(), options);
    if (!found.problem.empty()) {
      std::vector<std::string> names;
      for (const SceneShot* shot : shots) names.push_back(shot->file);
      throw InputError(rig.at(object.line) + ": objects." + object.piece_name() + ".pose.from",
                       fmt::format("{}: {}", fmt::join(names, ", "), found.problem));
    }
    const MovedPiece moved =
        moved_piece(rig.scene, objects.at(object.name), {found.off, found.covariance});
    move_pieces({{object.name, moved}}, rig.scene);
    out.push_back(moved.note);
    stage.step();
  }
  return out;
}

}  // namespace scattermeter::apps
