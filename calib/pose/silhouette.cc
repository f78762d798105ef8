#include "calib/pose/silhouette.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include "calib/pose/edge_scatter.h"
#include "calib/pose/edge_strip.h"
#include "core/base/chi_square.h"
#include "core/base/median.h"
#include "core/camera/lens.h"

namespace scattermeter::calib {
namespace {

using namespace edge_parameter;

constexpr int kCoarseWidth = 260;  // cells, at most, in the width at the first level
constexpr double kPiecesPerWidth = 150.0;
constexpr double kBesideCells = 1.5;
constexpr double kMinContrast = 0.25;  // mean of (in - out) / (in + out); 0 by chance, 1 at best
constexpr double kOutlier = 6.0;
constexpr int kMinPieces = 10;
constexpr std::size_t kMinLines = 3;

int coarse_factor(int width_px) {
  int factor = 2;
  while (width_px / factor > kCoarseWidth) factor *= 2;
  return factor;
}

// In place of a value: mean of the four around; negative where it is not in the picture.
struct Value {
  double signal;
  double noise;
};
Value value_at(const CfaSamples& s, const Eigen::Vector2d& at) {
  const int x = static_cast<int>(std::floor(at.x())) - s.x0;
  const int y = static_cast<int>(std::floor(at.y())) - s.y0;
  if (x < 0 || y < 0 || x + 1 >= s.width || y + 1 >= s.height) return {0, 1};
  const double fx = at.x() - std::floor(at.x());
  const double fy = at.y() - std::floor(at.y());
  const auto i =
      static_cast<std::size_t>(y) * static_cast<std::size_t>(s.width) + static_cast<std::size_t>(x);
  const auto w = static_cast<std::size_t>(s.width);
  const auto mix = [&](const std::vector<float>& v) {
    return (1 - fy) * ((1 - fx) * static_cast<double>(v[i]) + fx * static_cast<double>(v[i + 1])) +
           fy * ((1 - fx) * static_cast<double>(v[i + w]) + fx * static_cast<double>(v[i + w + 1]));
  };
  return {mix(s.signal_counts), std::sqrt(mix(s.variance_counts2))};
}

struct CoarsePiece {
  std::size_t shot;
  Eigen::Vector2d at_cell;
  Eigen::Vector2d outward;
};

// The camera turned so that the outline meets the shots'; false: not found.
bool turn_coarsely(const std::vector<EdgeShot>& shots, const std::vector<CfaSamples>& cells,
                   const Lens& lens, const CameraIntrinsics& intrinsics, int factor,
                   const SilhouetteOptions& options, Rigid3d* pose) {
  const double fx = intrinsics.fx_px;
  VisibleEdgesOptions seen;
  seen.step_rad = 6.0 * factor / fx;
  const Eigen::Vector3d eye_mm = inverse(*pose).translation_mm;
  std::vector<CoarsePiece> pieces;
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < shots.size(); ++i) {
    for (const EdgePiece& piece : visible_edges(*shots[i].scene, eye_mm, seen)) {
      if (piece.kind != EdgeKind::kContour) continue;
      const Eigen::Vector2d at = lens.project(*pose * piece.center_mm);
      const Eigen::Vector2d along = lens.project(*pose * (piece.center_mm + piece.half_mm)) - at;
      const Eigen::Vector2d aside =
          lens.project(*pose * (piece.center_mm + 0.01 * piece.half_mm.norm() * piece.outward)) -
          at;
      if (!at.allFinite() || !along.allFinite() || !aside.allFinite()) continue;
      Eigen::Vector2d outward = Eigen::Vector2d(-along.y(), along.x()).normalized();
      if (!outward.allFinite()) continue;
      if (outward.dot(aside) < 0) outward = -outward;
      pieces.push_back({i, (at.array() + 0.5) / factor - 0.5, outward});
      middle += at;
    }
  }
  if (pieces.empty()) return false;
  middle /= static_cast<double>(pieces.size());
  const int reach =
      std::max(2, static_cast<int>(std::ceil(options.search * intrinsics.width_px / factor)));
  double best = -1;
  Eigen::Vector2d shift = Eigen::Vector2d::Zero();
  for (int dy = -reach; dy <= reach; ++dy) {
    for (int dx = -reach; dx <= reach; ++dx) {
      double sum = 0;
      for (const CoarsePiece& p : pieces) {
        const Eigen::Vector2d at = p.at_cell + Eigen::Vector2d(dx, dy);
        const Value in = value_at(cells[p.shot], at - kBesideCells * p.outward);
        const Value out = value_at(cells[p.shot], at + kBesideCells * p.outward);
        const double level =
            std::abs(in.signal) + std::abs(out.signal) + 4 * (in.noise + out.noise);
        sum += (in.signal - out.signal) / std::max(level, 1e-12);
      }
      const double contrast = sum / static_cast<double>(pieces.size());
      if (contrast > best) {
        best = contrast;
        shift = Eigen::Vector2d(dx, dy);
      }
    }
  }
  if (best < kMinContrast || shift.cwiseAbs().maxCoeff() >= reach) return false;
  const Eigen::Vector3d from = lens.unproject(middle).homogeneous();
  const Eigen::Vector3d to = lens.unproject(middle + factor * shift).homogeneous();
  if (!from.allFinite() || !to.allFinite()) return false;
  const Eigen::Vector3d axis = from.cross(to);
  if (axis.isZero(0.0)) return true;
  const Eigen::AngleAxisd turn(std::atan2(axis.norm(), from.dot(to)), axis.normalized());
  *pose = Rigid3d{Eigen::Quaterniond(turn), Eigen::Vector3d::Zero()} * *pose;
  return true;
}

std::vector<int> pose_parameters() { return {0, 1, 2, 3, 4, 5}; }

// Hardly any knowledge: keeps what the outline does not tell from running away.
Eigen::MatrixXd loose_prior(Eigen::Index size, double distance_mm) {
  Eigen::MatrixXd prior = Eigen::MatrixXd::Zero(size, size);
  for (int i = 0; i < 3; ++i) {
    prior(i, i) = 1 / std::pow(0.3, 2);
    prior(3 + i, 3 + i) = 1 / std::pow(0.3 * distance_mm, 2);
  }
  return prior;
}

EdgeFit fit_pose(const std::vector<EdgePoint>& points, const CameraIntrinsics& intrinsics,
                 const Rigid3d& pose, EdgeFitOptions options) {
  options.free = pose_parameters();
  options.prior = loose_prior(edge_parameters(points), pose.translation_mm.norm());
  return fit_edges(points, intrinsics, pose, options);
}

std::size_t line_count(const std::vector<EdgePoint>& points) {
  std::set<std::pair<int, int>> lines;
  for (const EdgePoint& p : points) lines.insert({p.body_idx, p.line_idx});
  return lines.size();
}

// Nothing confirms a piece that is alone on its line, and where few lines are seen the pose gives
// way to it.
std::vector<EdgePoint> without_lone_pieces(const std::vector<EdgePoint>& points) {
  std::map<std::pair<int, int>, int> pieces;
  for (const EdgePoint& p : points) ++pieces[{p.body_idx, p.line_idx}];
  std::vector<EdgePoint> out;
  for (const EdgePoint& p : points) {
    if (pieces[{p.body_idx, p.line_idx}] > 1) out.push_back(p);
  }
  return out;
}

// Those within a few px of where the pose has them, and within a cell.
std::vector<EdgePoint> near(const std::vector<EdgePoint>& points,
                            const CameraIntrinsics& intrinsics, const Rigid3d& pose, int factor) {
  constexpr double kNear_px = 8;
  if (points.empty()) return {};
  const std::vector<double> off =
      edge_residuals_px(points, intrinsics, pose, Eigen::VectorXd::Zero(edge_parameters(points)));
  std::vector<EdgePoint> out;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (std::abs(off[i]) < kNear_px + factor) out.push_back(points[i]);
  }
  return out;
}

double robust_deviation(std::vector<double> residual) {
  return kStdPerMad * median_absolute_deviation(std::move(residual), 0.0);
}

Silhouette failed(SilhouetteStatus status, std::string message) {
  Silhouette s;
  s.status = status;
  s.message = std::move(message);
  return s;
}

}  // namespace

void SilhouetteOptions::Check() const {
  if (!(search > 0 && search <= 0.2)) {
    throw std::invalid_argument("SilhouetteOptions: search must be in (0, 0.2], got " +
                                std::to_string(search));
  }
  if (!(line_std_px >= 0) || !std::isfinite(line_std_px)) {
    throw std::invalid_argument("SilhouetteOptions: line_std_px must be >= 0, got " +
                                std::to_string(line_std_px));
  }
}

PixelRect silhouette_window(const RayScene& scene, const CameraIntrinsics& intrinsics,
                            const Rigid3d& camera_from_world, const SilhouetteOptions& options) {
  options.Check();
  double x0 = 1e30, y0 = 1e30, x1 = -1e30, y1 = -1e30;
  for (const Eigen::Vector2d& p :
       project(intrinsics, camera_from_world, scene.mesh().vertices_mm)) {
    if (!p.allFinite()) return {0, 0, intrinsics.width_px, intrinsics.height_px};
    x0 = std::min(x0, p.x());
    y0 = std::min(y0, p.y());
    x1 = std::max(x1, p.x());
    y1 = std::max(y1, p.y());
  }
  const double margin =
      options.search * intrinsics.width_px + 12 * coarse_factor(intrinsics.width_px);
  const auto low = [&](double v, int size) {
    return static_cast<int>(std::clamp(std::floor(v - margin), 0.0, static_cast<double>(size))) &
           ~1;
  };
  const auto high = [&](double v, int size) {
    return static_cast<int>(std::clamp(std::ceil(v + margin), 0.0, static_cast<double>(size)));
  };
  PixelRect r{low(x0, intrinsics.width_px), low(y0, intrinsics.height_px), 0, 0};
  r.width = std::max(0, high(x1, intrinsics.width_px) - r.x0);
  r.height = std::max(0, high(y1, intrinsics.height_px) - r.y0);
  return r;
}

Silhouette find_silhouette(const std::vector<EdgeShot>& shots, const CameraIntrinsics& intrinsics,
                           const Rigid3d& camera_from_world, const SilhouetteOptions& options) {
  options.Check();
  if (shots.empty()) throw std::invalid_argument("find_silhouette: no shots");
  const Lens lens(intrinsics);
  Rigid3d pose = camera_from_world;
  const int coarse = coarse_factor(intrinsics.width_px);
  // (1)
  if (!options.pose_is_near) {
    std::vector<CfaSamples> cells;
    for (const EdgeShot& shot : shots) cells.push_back(cell_means(shot.samples, coarse));
    if (!turn_coarsely(shots, cells, lens, intrinsics, coarse, options, &pose)) {
      return failed(SilhouetteStatus::kNotFound,
                    "the body's outline is not seen against a darker background near where pose "
                    "and mesh put it: look at pose, mesh and shots");
    }
  }
  // (2)
  std::vector<EdgePoint> points;
  const auto settle = [&](int factor, double search, double half_width, int times) {
    for (int i = 0; i < times; ++i) {
      EdgePointOptions o;
      o.factor = factor;
      o.search_px = search;
      o.half_width_px = half_width;
      o.piece_px = std::max(o.piece_px, intrinsics.width_px / factor / kPiecesPerWidth);
      points = edge_points(shots, intrinsics, pose, o);
      if (options.pose_is_near) points = near(points, intrinsics, camera_from_world, factor);
      points = without_lone_pieces(points);
      if (points.size() < kMinPieces || line_count(points) < kMinLines) return false;
      EdgeFitOptions fit;
      fit.robust = true;
      fit.robust_px = 0.3 * factor;
      const EdgeFit f = fit_pose(points, intrinsics, pose, fit);
      if (!f.converged) return false;
      pose = f.camera_from_world;
    }
    return true;
  };
  const std::string too_few =
      "too few lit straight edges of the body's outline are found: a darker background, longer "
      "exposure, or light from another side";
  bool found = settle(coarse, 2.5, 3.0, 3) || options.pose_is_near;
  for (int factor = coarse / 2; found && factor >= 2; factor /= 2) {
    found = settle(factor, 2.0, 4.0, 2) || options.pose_is_near;
  }
  found = found && settle(1, 2.0, 5.0, 1) && settle(1, 1.0, 5.0, 1);
  if (!found) return failed(SilhouetteStatus::kTooFewPieces, too_few);
  // (3)
  Silhouette out;
  EdgeFitOptions fit;
  fit.robust = true;
  fit.robust_px = 0.1;
  EdgeFit f = fit_pose(points, intrinsics, pose, fit);
  const double deviation = std::max(robust_deviation(f.residual_px), 0.005);
  std::vector<EdgePoint> kept;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (std::abs(f.residual_px[i]) <= kOutlier * std::hypot(deviation, points[i].std_px)) {
      kept.push_back(points[i]);
    }
  }
  out.pieces_left_out = points.size() - kept.size();
  if (kept.size() < kMinPieces || line_count(kept) < kMinLines) {
    return failed(SilhouetteStatus::kTooFewPieces, too_few);
  }
  fit.robust = false;
  fit.free = pose_parameters();
  fit.prior = loose_prior(edge_parameters(kept), pose.translation_mm.norm());
  const EdgeScatter scatter = edge_scatter(kept, intrinsics, pose, fit, options.line_std_px);
  fit.line_std_px = scatter.line_std_px;
  fit.piece_std_px = scatter.piece_std_px;
  f = fit_edges(kept, intrinsics, pose, fit);
  const double worst_rad = std::sqrt(f.covariance.block<3, 3>(0, 0).trace());
  const double worst_mm = std::sqrt(f.covariance.block<3, 3>(3, 3).trace());
  if (!f.converged || !(worst_rad < 0.05) || !(worst_mm < 0.05 * pose.translation_mm.norm())) {
    return failed(SilhouetteStatus::kIllConditioned,
                  "the edges that are found do not tell the pose: more of the outline must be lit");
  }
  out.status = SilhouetteStatus::kOk;
  out.line_std_px = scatter.line_std_px;
  out.piece_std_px = scatter.piece_std_px;
  out.camera_from_world = f.camera_from_world;
  out.points = std::move(kept);
  const std::vector<double> given =
      edge_residuals_px(out.points, intrinsics, camera_from_world,
                        Eigen::VectorXd::Zero(edge_parameters(out.points)));
  for (std::size_t i = 0; i < out.points.size(); ++i) out.points[i].offset_px = given[i];
  return out;
}

EdgeFit fit_with_pose(const Silhouette& silhouette, const CameraIntrinsics& intrinsics,
                      const PoseResult& prior) {
  const Eigen::Index size = edge_parameters(silhouette.points);
  EdgeFitOptions fit;
  fit.free = pose_parameters();
  fit.line_std_px = silhouette.line_std_px;
  fit.piece_std_px = silhouette.piece_std_px;
  fit.prior = Eigen::MatrixXd::Zero(size, size);
  fit.prior.topLeftCorner<6, 6>() = prior.covariance.ldlt().solve(Eigen::MatrixXd::Identity(6, 6));
  return fit_edges(silhouette.points, intrinsics, prior.camera_from_world, fit);
}

PoseResult combine(const Silhouette& silhouette, const CameraIntrinsics& intrinsics,
                   const PoseResult& prior) {
  PoseResult out = prior;
  const Eigen::Index size = edge_parameters(silhouette.points);
  EdgeFitOptions fit;
  fit.free = pose_parameters();
  fit.line_std_px = silhouette.line_std_px;
  fit.piece_std_px = silhouette.piece_std_px;
  // The silhouette alone, then with the prior: what the least squares grow by is the distance of
  // the two, a chi-square of six.
  fit.prior = loose_prior(size, prior.camera_from_world.translation_mm.norm());
  const EdgeFit alone = fit_edges(silhouette.points, intrinsics, silhouette.camera_from_world, fit);
  const EdgeFit both = fit_with_pose(silhouette, intrinsics, prior);
  if (!alone.converged || !both.converged) {
    out.status = PoseStatus::kIllConditioned;
    out.message = "the silhouette's least squares do not settle";
    return out;
  }
  if (chi_square_tail(std::max(0.0, both.chi2 - alone.chi2), 6) < 1e-6) {
    out.status = PoseStatus::kNoConsensus;
    out.message =
        "the object's silhouette and the pose contradict each other: camera, object or lens have "
        "changed since the points were measured, or the mesh is not the object";
    return out;
  }
  out.camera_from_world = both.camera_from_world;
  out.covariance = both.covariance.topLeftCorner<6, 6>();
  out.noise_std_px = silhouette.line_std_px;
  out.rms_px = 0;
  out.worst_px = 0;
  for (const double r : both.residual_px) {
    out.rms_px += r * r / static_cast<double>(both.residual_px.size());
    out.worst_px = std::max(out.worst_px, std::abs(r));
  }
  out.rms_px = std::sqrt(out.rms_px);
  // Centre -R^T t: its displacement is -R^T (dt - w x t) = -R^T (dt + [t]_x w).
  const Eigen::Matrix3d rt = out.camera_from_world.rotation.conjugate().toRotationMatrix();
  const Eigen::Vector3d t = out.camera_from_world.translation_mm;
  Eigen::Matrix3d cross;
  cross << 0, -t.z(), t.y(), t.z(), 0, -t.x(), -t.y(), t.x(), 0;
  Eigen::Matrix<double, 3, 6> by_pose;
  by_pose << -rt * cross, -rt;
  out.center_std_mm =
      (by_pose * out.covariance * by_pose.transpose()).diagonal().cwiseMax(0.0).cwiseSqrt();
  return out;
}

}  // namespace scattermeter::calib
