#include "apps/looks/piece_places.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <numbers>
#include <optional>
#include <set>
#include <utility>

#include <Eigen/Geometry>
#include <fmt/core.h>
#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>

#include "apps/looks/outline_finding.h"
#include "apps/rig/open_objects.h"
#include "calib/pose/piece_pose.h"
#include "calib/pose/shot_pose.h"
#include "calib/pose/silhouette_check.h"
#include "capture/files/file_kind.h"
#include "capture/shots/raw_shot.h"
#include "core/base/chi_square.h"
#include "core/base/dense_solve.h"
#include "core/base/input_error.h"
#include "core/base/symmetric_eigen.h"
#include "core/nuisances/view_shift.h"

namespace scattermeter::apps {
namespace {

constexpr std::size_t kShots = 4;

const SceneShot& in_scene(const SceneShot& shot) { return shot; }
const SceneShot& in_scene(const ObservedShot& shot) { return *shot.stated; }

// Of the object, first those under lights that no earlier one has.
template <class Shot>
std::vector<const Shot*> shots_of(const std::vector<Shot>& shots, const std::string& object) {
  std::vector<const Shot*> out, others;
  std::set<std::vector<std::string>> lights;
  for (const Shot& shot : shots) {
    if (in_scene(shot).object != object) continue;
    (lights.insert(in_scene(shot).lights).second ? out : others).push_back(&shot);
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

calib::PiecePoseOptions options_for(const Rig& rig, const ObjectScene& object) {
  calib::PiecePoseOptions out;
  out.silhouette.line_std_px = rig.pose.edge_std_px;
  out.silhouette.may_lack_parts = rig.pose.charuco.has_value();
  out.scale_relative_std = object.stated->scale_relative_std;
  out.size_mm = object.size_mm();
  return out;
}

double degrees(const Eigen::Vector3d& turn_rad) {
  return 180.0 / std::numbers::pi * turn_rad.norm();
}

std::string sentence(const SceneObject& object, const calib::PiecePose& found) {
  return fmt::format(
      "{} was found by its outline [{:.2f}, {:.2f}, {:.2f}] mm from where the rig states it, "
      "turned "
      "by {:.2f} degrees; its position is known to {:.2g} mm",
      object.name, found.off[0], found.off[1], found.off[2], degrees(found.off.tail<3>()),
      object.position_std_mm);
}

// Covariance of (displacement of the centre, turn) as stated.
Eigen::Matrix<double, 6, 6> stated_covariance(const ObjectScene& object) {
  const double std_mm = object.stated->position_std_mm;
  Eigen::Matrix<double, 6, 1> std;
  std << Eigen::Vector3d::Constant(std_mm), Eigen::Vector3d::Constant(std_mm / object.size_mm());
  return std.cwiseAbs2().asDiagonal();
}

// What a displacement along the line of sight may be instead: an object of another size, or a board
// of another; "" where it is none.
std::string or_of_another_size(const Eigen::Vector3d& off_mm, const Eigen::Vector3d& to_camera_mm,
                               bool by_board) {
  constexpr double kMostAside = 0.2;
  constexpr double kVisible = 0.005;
  const double along_mm = off_mm.dot(to_camera_mm.normalized());
  const double growth = along_mm / (to_camera_mm.norm() - along_mm);
  const double aside_mm = (off_mm - along_mm * to_camera_mm.normalized()).norm();
  if (aside_mm > kMostAside * std::abs(along_mm) || !(std::abs(growth) > kVisible)) return "";
  return fmt::format(", or is {:.1f} % {} than its mesh", 100.0 * std::abs(growth),
                     growth > 0.0 ? "larger" : "smaller") +
         (by_board ? or_of_another_board(growth) : "");
}

// Without shots; absent for an object that stands as stated. camera: one that sees it.
std::optional<Finding> misplaced(const Rig& rig, const ObjectScene& object,
                                 const calib::PiecePose& found, const PoseResult& camera) {
  constexpr double kDoubt = 1e-4;
  const std::string& name = object.stated->name;
  // As a displacement or a turn from four stated deviations on, as by the fit, or as both.
  const Eigen::Matrix<double, 6, 6> expected = stated_covariance(object) + found.covariance;
  const auto chi2 = [&](Eigen::Index first, Eigen::Index n) {
    const Eigen::VectorXd off = found.off.segment(first, n);
    return off.dot(SymmetricSolver(expected.block(first, first, n, n)).solve(off));
  };
  if (std::max(chi2(0, 3), chi2(3, 3)) < kMostPull * kMostPull &&
      chi_square_tail(chi2(0, 6), 6.0) > kDoubt) {
    return std::nullopt;
  }
  const Eigen::Vector3d to_camera_mm =
      inverse(camera.camera_from_world).translation_mm - object.box.center_mm();
  return Finding{
      "mesh displaced",
      fmt::format("mesh displaced: by its outline, {} stands [{:.2f}, {:.2f}, {:.2f}] "
                  "mm from where the rig states it, turned by {:.1f} degrees{}",
                  name, found.off[0], found.off[1], found.off[2], degrees(found.off.tail<3>()),
                  or_of_another_size(found.off.head<3>(), to_camera_mm,
                                     board_distance_mm(rig.pose, camera) > 0.0)),
      fmt::format("put the object back, or have it found by its outline "
                  "(objects.{}.pose: {{from: silhouette}}){}; another piece needs its own mesh",
                  name,
                  rig.pose.charuco ? "" : "; if the camera was moved, take the pose points again"),
      {}};
}

struct ShotsOfPose {
  PoseResult camera;
  std::vector<std::size_t> shots;  // indices into the scene's
};

// By the outline of an object about where it is stated to stand.
calib::PiecePose found_near(const Rig& rig, const ObjectScenes& objects, const ObjectScene& object,
                            const std::vector<ShotsOfPose>& poses,
                            const capture::FrameSource& frames) {
  constexpr double kNear = 0.08;  // of the frame's width: 5 mm on an object that fills a third
  calib::PiecePoseOptions options = options_for(rig, object);
  options.silhouette.search = kNear;
  options.may_be_turned = false;
  std::vector<calib::PieceView> views(poses.size());
  tbb::parallel_for(std::size_t{0}, views.size(), [&](std::size_t i) {
    views[i].camera = poses[i].camera;
    for (const std::size_t idx : poses[i].shots) {
      views[i].shots.push_back(calib::edge_shot(rig.scene, rig.pose, objects, rig.scene.shots[idx],
                                                frames(idx, 0), poses[i].camera.camera_from_world,
                                                options.silhouette));
    }
  });
  return calib::find_piece(views, rig.scene.camera.intrinsics, object.box.center_mm(), options);
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
    const std::vector<const SceneShot*> shots = shots_of(rig.scene.shots, object.name);
    if (!is_wanted(object) || shots.empty()) continue;
    calib::PiecePoseOptions options = options_for(rig, objects.at(object.name));
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
    object.world_from_mesh = found.moved * object.world_from_mesh;
    const auto largest = [&](Eigen::Index first) {
      return std::sqrt(symmetric_eigen(found.covariance.block<3, 3>(first, first)).values[2]);
    };
    object.position_std_mm = std::max(largest(0), options.size_mm * largest(3));
    out.push_back(sentence(object, found));
    stage.step();
  }
  return out;
}

OutlineFindings look_at_pieces(const Rig& rig, const ObjectScenes& objects,
                               const std::vector<ObservedShot>& shots,
                               const capture::FrameSource& frames) {
  OutlineFindings out;
  bool moves = false;
  for (const auto& [name, object] : objects) {
    const std::vector<const ObservedShot*> telling = shots_of(shots, name);
    // Those to be found stand where their outline showed them already.
    if (telling.empty() || object.stated->to_be_found) continue;
    if (object.is_round) {
      out.unjudged.insert(name);
      continue;
    }
    std::vector<ShotsOfPose> views;
    for (const ObservedShot* shot : telling) {
      views.push_back({shot->pose, {rig.scene.index_of(*shot->stated)}});
    }
    const calib::PiecePose found = found_near(rig, objects, object, views, frames);
    if (!found.problem.empty()) {
      out.unjudged.insert(name);
      out.notes.push_back(
          fmt::format("outline of {} is not judged, so pose and mesh are not checked: {}", name,
                      found.problem));
      continue;
    }
    const Eigen::Matrix<double, 6, 6> stated = stated_covariance(object);
    std::optional<Finding> finding = misplaced(rig, object, found, telling.front()->pose);
    const Eigen::Matrix<double, 6, 1> probable =
        stated * SymmetricSolver(stated + found.covariance).solve(found.off);
    for (const ObservedShot& shot : shots) {
      if (shot.stated->object != name) continue;
      if (finding) {
        finding->shots.push_back(rig.scene.index_of(*shot.stated));
      } else {
        const PoseShift& by = out.shifts[shot.view_name()] =
            pose_shift_by_place(shot.pose.camera_from_world, object.box.center_mm()) * probable;
        moves = moves || motion_in_patches(shot, by) > kVisibleMotion;
      }
    }
    if (finding) out.findings.push_back(std::move(*finding));
  }
  if (!moves) out.shifts.clear();
  return out;
}

std::optional<Finding> misplaced_piece(const Rig& rig, const ObjectScenes& objects,
                                       const std::string& object, const PoseResult& pose,
                                       std::vector<std::size_t> shots,
                                       const capture::FrameSource& frames) {
  const ObjectScene& stated = objects.at(object);
  std::vector<std::size_t> telling = shots;
  telling.resize(std::min(telling.size(), kShots));
  const calib::PiecePose found =
      found_near(rig, objects, stated, {{pose, std::move(telling)}}, frames);
  std::optional<Finding> out;
  if (found.problem.empty()) out = misplaced(rig, stated, found, pose);
  if (out) out->shots = std::move(shots);
  return out;
}

}  // namespace scattermeter::apps
