#include "apps/instrument/piece_places.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <numbers>
#include <set>
#include <utility>

#include <Eigen/Geometry>
#include <fmt/core.h>
#include <fmt/format.h>

#include "apps/instrument/open_objects.h"
#include "calib/pose/piece_pose.h"
#include "calib/pose/shot_pose.h"
#include "calib/pose/silhouette_check.h"
#include "capture/files/file_kind.h"
#include "capture/shots/raw_shot.h"
#include "core/base/input_error.h"
#include "core/base/symmetric_eigen.h"

namespace scattermeter::apps {
namespace {

constexpr std::size_t kShots = 4;

// Of the object, first those under lights that no earlier one has.
std::vector<const SceneShot*> shots_of(const Scene& scene, const std::string& object) {
  std::vector<const SceneShot*> out, others;
  std::set<std::vector<std::string>> lights;
  for (const SceneShot& shot : scene.shots) {
    if (shot.object != object) continue;
    (lights.insert(shot.lights).second ? out : others).push_back(&shot);
  }
  out.insert(out.end(), others.begin(), others.end());
  out.resize(std::min(out.size(), kShots));
  return out;
}

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

std::string sentence(const SceneObject& object, const calib::PiecePose& found,
                     const Eigen::Vector3d& moved_mm) {
  const Eigen::AngleAxisd turn(found.moved.rotation);
  return fmt::format(
      "{} was found by its outline [{:.2f}, {:.2f}, {:.2f}] mm from where the rig states it, "
      "turned "
      "by {:.2f} degrees; its position is known to {:.2g} mm",
      object.name, moved_mm.x(), moved_mm.y(), moved_mm.z(),
      180.0 / std::numbers::pi * std::min(turn.angle(), 2.0 * std::numbers::pi - turn.angle()),
      object.position_std_mm);
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
    const std::vector<const SceneShot*> shots = shots_of(rig.scene, object.name);
    if (!is_wanted(object) || shots.empty()) continue;
    const ObjectScene& stated = objects.at(object.name);
    calib::PiecePoseOptions options;
    options.silhouette.line_std_px = rig.pose.edge_std_px;
    options.silhouette.may_lack_parts = rig.pose.charuco.has_value();
    options.scale_relative_std = object.scale_relative_std;
    options.is_on_plane = object.to_be_found->is_on_plane;
    options.size_mm = stated.size_mm();
    const Eigen::Vector3d center_mm = stated.box.center_mm();
    const calib::PiecePose found =
        calib::find_piece(views_of(rig, objects, shots, shots_folder, options.silhouette),
                          rig.scene.camera.intrinsics, center_mm, options);
    if (!found.problem.empty()) {
      std::vector<std::string> names;
      for (const SceneShot* shot : shots) names.push_back(shot->file);
      throw InputError(rig.at(object.line) + ": objects." + object.piece_name() + ".pose.from",
                       fmt::format("{}: {}", fmt::join(names, ", "), found.problem));
    }
    object.world_from_mesh = found.moved * object.world_from_mesh;
    const auto largest = [&](Eigen::Index first) {
      return std::sqrt(symmetric_eigen(found.covariance.block<3, 3>(first, first)).values[2]);
    };
    object.position_std_mm = std::max(largest(0), options.size_mm * largest(3));
    out.push_back(sentence(object, found, found.moved * center_mm - center_mm));
    stage.step();
  }
  return out;
}

}  // namespace scattermeter::apps
