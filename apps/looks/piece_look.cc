#include "apps/looks/piece_look.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>

#include <Eigen/Geometry>
#include <fmt/core.h>
#include <oneapi/tbb/parallel_for.h>

#include "apps/looks/closer_look.h"
#include "apps/looks/outline_finding.h"
#include "calib/pose/shot_pose.h"
#include "calib/pose/silhouette_check.h"
#include "core/base/chi_square.h"
#include "core/base/dense_solve.h"
#include "core/nuisances/view_shift.h"

namespace scattermeter::apps {
namespace {

std::vector<const ObservedShot*> telling_of(const std::vector<ObservedShot>& shots,
                                            const std::string& object) {
  std::vector<SceneShot> stated;
  for (const ObservedShot& shot : shots) stated.push_back(*shot.stated);
  std::vector<const ObservedShot*> out;
  for (const std::size_t idx : telling_shots(stated, object)) out.push_back(&shots[idx]);
  return out;
}

double degrees(const Eigen::Vector3d& turn_rad) {
  return 180.0 / std::numbers::pi * turn_rad.norm();
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

// By the outline and the stated position together.
PiecePlace most_probable(const ObjectScene& object, const calib::PiecePose& found) {
  const Eigen::Matrix<double, 6, 6> stated = stated_covariance(object);
  const Eigen::Matrix<double, 6, 6> gain =
      SymmetricSolver(stated + found.covariance).solve_columns(stated).transpose();
  return {gain * found.off, gain * found.covariance};
}

struct ShotsOfPose {
  PoseResult camera;
  std::vector<std::size_t> shots;  // indices into the scene's
};

// An outline farther in than the mesh's is that of a piece farther away, or of cut edges: how far
// away is then as uncertain as these make it.
void allow_for_cut_edges(const Rig& rig, const ObjectScene& object, const PoseResult& camera,
                         calib::PiecePose& found) {
  const CameraIntrinsics& lens = rig.scene.camera.intrinsics;
  const Eigen::Vector3d from_camera_mm =
      object.box.center_mm() - inverse(camera.camera_from_world).translation_mm;
  if (!(found.off.head<3>().dot(from_camera_mm) > 0.0)) return;
  const double relative = edge_cut_px(lens, object, camera) /
                          (0.5 * object.size_mm() * px_per_mm(lens, object, camera));
  found.covariance.topLeftCorner<3, 3>() +=
      relative * relative * from_camera_mm * from_camera_mm.transpose();
}

// By the outline of an object about where it is stated to stand.
calib::PiecePose found_near(const Rig& rig, const ObjectScenes& objects, const ObjectScene& object,
                            const std::vector<ShotsOfPose>& poses,
                            const capture::FrameSource& frames) {
  constexpr double kNear = 0.08;  // of the frame's width: 5 mm on an object that fills a third
  calib::PiecePoseOptions options = piece_pose_options(rig, object);
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
  calib::PiecePose found =
      calib::find_piece(views, rig.scene.camera.intrinsics, object.box.center_mm(), options);
  allow_for_cut_edges(rig, object, poses.front().camera, found);
  return found;
}

// Where the outline shows the object, if that is elsewhere than stated and it may move.
std::optional<MovedPiece> moved_to(const Rig& rig, const ObjectScene& object,
                                   const calib::PiecePose& found) {
  constexpr double kChance = 1e-4;
  const double chi2 = found.off.dot(SymmetricSolver(found.covariance).solve(found.off));
  if (!may_move(rig.scene, *object.stated) || chi_square_tail(chi2, 6.0) > kChance) {
    return std::nullopt;
  }
  return moved_piece(rig.scene, object, most_probable(object, found));
}

}  // namespace

calib::PiecePoseOptions piece_pose_options(const Rig& rig, const ObjectScene& object) {
  calib::PiecePoseOptions out;
  out.silhouette.line_std_px = rig.pose.edge_std_px;
  out.silhouette.may_lack_parts = rig.pose.charuco.has_value();
  out.scale_relative_std = object.stated->scale_relative_std;
  out.size_mm = object.size_mm();
  return out;
}

std::vector<std::size_t> telling_shots(const std::vector<SceneShot>& shots,
                                       const std::string& object) {
  std::vector<std::size_t> out, others;
  std::set<std::vector<std::string>> lights;
  for (std::size_t i = 0; i < shots.size(); ++i) {
    if (shots[i].object != object) continue;
    (lights.insert(shots[i].lights).second ? out : others).push_back(i);
  }
  out.insert(out.end(), others.begin(), others.end());
  out.resize(std::min(out.size(), kTellingShots));
  return out;
}

OutlineFindings look_at_pieces(const Rig& rig, const ObjectScenes& objects,
                               const std::vector<ObservedShot>& shots,
                               const capture::FrameSource& frames) {
  OutlineFindings out;
  bool moves = false;
  for (const auto& [name, object] : objects) {
    const std::vector<const ObservedShot*> telling = telling_of(shots, name);
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
    std::optional<Finding> finding = misplaced(rig, object, found, telling.front()->pose);
    const PiecePlace place = most_probable(object, found);
    if (auto moved = moved_to(rig, object, found); moved && !finding) {
      out.moved[name] = std::move(*moved);
    }
    for (const ObservedShot& shot : shots) {
      if (shot.stated->object != name) continue;
      if (finding) {
        finding->shots.push_back(rig.scene.index_of(*shot.stated));
      } else {
        const PoseShift& by = out.shifts[shot.view_name()] =
            pose_shift_by_place(shot.pose.camera_from_world, object.box.center_mm()) * place.off;
        moves = moves || motion_in_patches(shot, by) > kVisibleMotion;
      }
    }
    if (finding) out.findings.push_back(std::move(*finding));
  }
  if (!moves) {
    out.shifts.clear();
    out.moved.clear();
  }
  return out;
}

PieceLook look_at_piece(const Rig& rig, const ObjectScenes& objects, const std::string& object,
                        const PoseResult& pose, std::vector<std::size_t> shots,
                        const capture::FrameSource& frames) {
  const ObjectScene& stated = objects.at(object);
  std::vector<std::size_t> telling = shots;
  telling.resize(std::min(telling.size(), kTellingShots));
  const calib::PiecePose found =
      found_near(rig, objects, stated, {{pose, std::move(telling)}}, frames);
  PieceLook out;
  if (!found.problem.empty()) return out;
  out.finding = misplaced(rig, stated, found, pose);
  if (out.finding) {
    out.finding->shots = std::move(shots);
  } else {
    out.moved = moved_to(rig, stated, found);
  }
  return out;
}

OutlineFindings look_at_pieces(const Rig& rig, const ObjectScenes& objects, const PoseResult& pose,
                               const std::vector<ObservedShot>& shots,
                               const capture::FrameSource& frames) {
  OutlineFindings out;
  for (const auto& [name, object] : objects) {
    std::vector<std::size_t> telling;
    for (const ObservedShot* shot : telling_of(shots, name)) {
      telling.push_back(rig.scene.index_of(*shot->stated));
    }
    if (object.is_round || telling.empty()) continue;
    PieceLook look = look_at_piece(rig, objects, name, pose, std::move(telling), frames);
    if (look.finding) {
      look.finding->shots.clear();
      for (const ObservedShot& shot : shots) {
        if (shot.stated->object != name) continue;
        look.finding->shots.push_back(rig.scene.index_of(*shot.stated));
      }
      out.findings.push_back(std::move(*look.finding));
    }
    if (look.moved) out.moved[name] = std::move(*look.moved);
  }
  return out;
}

}  // namespace scattermeter::apps
