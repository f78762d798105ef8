#include "calib/pose/silhouette_check.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

#include <fmt/core.h>

#include "calib/board/board_mask.h"
#include "capture/sensor/linear_samples.h"
#include "core/base/chi_square.h"
#include "core/base/dense_solve.h"

namespace scattermeter::calib {
namespace {

constexpr double kDriftDoubt = 1e-4;
// Of the paper beside the body, px: for the blur of the lens, and where the body may stand by three
// of its standard deviations.
int paper_border_px(const ObjectScene& object, const CameraIntrinsics& intrinsics,
                    const Rigid3d& camera_from_world) {
  constexpr double kBlur_px = 3.0;
  const double depth_mm = (camera_from_world * object.box.center_mm()).z();
  return static_cast<int>(
      std::ceil(kBlur_px + 3.0 * object.stated->position_std_mm * intrinsics.fx_px / depth_mm));
}

struct Shift {
  Eigen::Vector2d px;
  Eigen::Matrix2d covariance;
};

// Shift of the outline (right, down) by least squares of offset_px, with the remaining sum of
// squares and a covariance from noise and scatter of lines; offsets of one line have the error
// line_std_px in common.
Shift shift_of(const std::vector<EdgePoint>& points, double line_std_px, double piece_std_px) {
  std::map<std::pair<int, int>, std::vector<const EdgePoint*>> lines;
  for (const EdgePoint& p : points) lines[{p.body_idx, p.line_idx}].push_back(&p);
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
  Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
  for (const auto& [key, pieces] : lines) {
    const auto n = static_cast<Eigen::Index>(pieces.size());
    Eigen::MatrixXd c = Eigen::MatrixXd::Constant(n, n, line_std_px * line_std_px);
    Eigen::MatrixXd a(n, 2);
    Eigen::VectorXd b(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const EdgePoint& p = *pieces[static_cast<std::size_t>(i)];
      c(i, i) += p.std_px * p.std_px + piece_std_px * piece_std_px;
      a.row(i) = p.outward.transpose();
      b[i] = p.offset_px;
    }
    const Eigen::MatrixXd weighted = SymmetricSolver(c).solve_columns(a);
    information += weighted.transpose() * a;
    gradient += weighted.transpose() * b;
  }
  const Eigen::Matrix2d covariance = SymmetricSolver(information).inverse();
  return {covariance * gradient, covariance};
}

// Shifts of the offsets that remain after the fit of all causes, of every shot relative to the
// first of its object. Both have the same edges, so that errors of mesh, lens and scattered light
// cancel, except for the change of the scattered light with another LED, for which half of
// line_std_px is assumed.
void find_drift(double line_std_px, SilhouetteCheck& check) {
  std::vector<Shift> shifts;
  auto residual = check.diagnosis.residual_px.begin();
  for (const SilhouetteShot& shot : check.shots) {
    std::vector<EdgePoint> left = shot.points;
    for (EdgePoint& p : left) p.offset_px = *residual++;
    shifts.push_back(shot.found ? shift_of(left, 0.5 * line_std_px, 0.0) : Shift{});
  }
  double chi2 = 0;
  int freedom = 0;
  for (std::size_t i = 0; i < check.shots.size(); ++i) {
    const SilhouetteShot& shot = check.shots[i];
    if (!shot.found) continue;
    const auto first =
        std::find_if(check.shots.begin(), check.shots.end(),
                     [&](const SilhouetteShot& s) { return s.found && s.object == shot.object; });
    if (&*first == &shot) continue;
    const Shift& from = shifts[static_cast<std::size_t>(first - check.shots.begin())];
    const Eigen::Vector2d d = shifts[i].px - from.px;
    const Eigen::Matrix2d c = shifts[i].covariance + from.covariance;
    const double squared = d.dot(SymmetricSolver(c).solve(d));
    chi2 += squared;
    freedom += 2;
    if (d.norm() > check.drift_px || freedom == 2) {
      const Eigen::Vector2d u = d.norm() > 0 ? d.normalized().eval() : Eigen::Vector2d(1, 0);
      check.drift_px = d.norm();
      check.drift_std_px = std::sqrt(u.dot(c * u));
      check.drift_verdict = fmt::format(
          "camera or object moved by {:.2f} +- {:.2f} px between {} "
          "and {}",
          check.drift_px, check.drift_std_px, first->file, shot.file);
    }
  }
  check.drifts = freedom > 0 && chi_square_tail(chi2, freedom) < kDriftDoubt;
  if (!check.drifts) check.drift_verdict.clear();
}

}  // namespace

std::string SilhouetteCheck::verdict() const {
  if (shots_found == 0) return "no outline found: " + shots.front().problem;
  if (drifts) return drift_verdict;
  return diagnosis.verdict;
}

EdgeShot edge_shot(const Scene& scene, const PoseSource& source, const ObjectScenes& objects,
                   const SceneShot& shot, const capture::RawFrame& frame,
                   const Rigid3d& camera_from_world, const SilhouetteOptions& options) {
  const ObjectScene& object = objects.at(shot.object);
  const PixelRect w =
      silhouette_window(*object.rays, scene.camera.intrinsics, camera_from_world, options);
  int body = 0;
  while (scene.objects[static_cast<std::size_t>(body)].name != shot.object) ++body;
  EdgeShot out{object.rays.get(), body,
               capture::linear_samples(frame, scene.camera.sensor.noise, frame.exposure_s, w.x0,
                                       w.y0, w.width, w.height)};
  if (source.charuco) {
    mask_paper(*source.charuco, *object.rays, scene.camera.intrinsics, camera_from_world,
               paper_border_px(object, scene.camera.intrinsics, camera_from_world), out.samples);
  }
  return out;
}

SilhouetteCheck check_silhouettes(const Scene& scene, const PoseSource& source,
                                  const ObjectScenes& objects, const capture::FrameSource& frames,
                                  const std::vector<std::size_t>& shot_idxs,
                                  const PoseResult& stated, const SilhouetteCheckOptions& options) {
  SilhouetteCheck check;
  const CameraIntrinsics& lens = scene.camera.intrinsics;
  std::vector<EdgePoint> points;
  double squares = 0;
  for (const std::size_t idx : shot_idxs) {
    const SceneShot& rig_shot = scene.shots.at(idx);
    SilhouetteShot shot;
    shot.file = rig_shot.file;
    shot.object = rig_shot.object;
    const Silhouette found =
        find_silhouette({edge_shot(scene, source, objects, rig_shot, frames(idx, 0),
                                   stated.camera_from_world, options.silhouette)},
                        lens, stated.camera_from_world, options.silhouette);
    shot.found = found.status == SilhouetteStatus::kOk;
    shot.problem = found.message;
    shot.pieces_left_out = found.pieces_left_out;
    if (shot.found) {
      ++check.shots_found;
      shot.pieces = found.points.size();
      double sum = 0;
      for (EdgePoint p : found.points) {
        sum += p.offset_px * p.offset_px;
        shot.worst_px = std::max(shot.worst_px, std::abs(p.offset_px));
        p.shot_idx = static_cast<int>(check.shots.size());
        shot.points.push_back(p);
        points.push_back(p);
      }
      squares += sum;
      shot.rms_px = std::sqrt(sum / static_cast<double>(shot.pieces));
      check.worst_px = std::max(check.worst_px, shot.worst_px);
      const Shift shift = shift_of(shot.points, found.line_std_px, found.piece_std_px);
      shot.shift_px = shift.px;
      shot.shift_std_px = shift.covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
    }
    check.shots.push_back(std::move(shot));
  }
  if (points.empty()) return check;
  check.rms_px = std::sqrt(squares / static_cast<double>(points.size()));
  std::vector<std::string> names;
  for (const SceneObject& o : scene.objects) names.push_back(o.name);
  check.diagnosis = explain_edges(points, lens, stated, names, options.explanation);
  find_drift(options.silhouette.line_std_px, check);
  return check;
}

SilhouetteCheck check_silhouettes_apart(const Scene& scene, const PoseSource& source,
                                        const ObjectScenes& objects,
                                        const capture::FrameSource& frames,
                                        const std::vector<std::size_t>& shot_idxs,
                                        const std::vector<PoseResult>& stated,
                                        const SilhouetteCheckOptions& options) {
  if (stated.size() != shot_idxs.size()) {
    throw std::invalid_argument(fmt::format("check_silhouettes_apart: {} shots, {} poses",
                                            shot_idxs.size(), stated.size()));
  }
  SilhouetteCheckOptions near = options;
  near.silhouette.pose_is_near = true;
  SilhouetteCheck all;
  double squares = 0, pieces = 0;
  for (std::size_t i = 0; i < shot_idxs.size(); ++i) {
    SilhouetteCheck one =
        check_silhouettes(scene, source, objects, frames, {shot_idxs[i]}, stated[i], near);
    if (one.shots_found > 0) {
      // The diagnosis is that of the first shot that contradicts the rig.
      if (all.shots_found == 0 || (all.diagnosis.agrees && !one.diagnosis.agrees)) {
        all.diagnosis = one.diagnosis;
        if (!one.diagnosis.agrees) {
          all.diagnosis.verdict = one.shots.front().file + ": " + one.diagnosis.verdict;
        }
      }
      const auto n = static_cast<double>(one.shots.front().pieces);
      squares += n * one.rms_px * one.rms_px;
      pieces += n;
      all.worst_px = std::max(all.worst_px, one.worst_px);
      all.shots_found += 1;
    }
    all.shots.push_back(std::move(one.shots.front()));
  }
  if (pieces > 0) all.rms_px = std::sqrt(squares / pieces);
  return all;
}

}  // namespace scattermeter::calib
