#include "calib/pose/silhouette.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

#include "calib/pose/coarse_turn.h"
#include "calib/pose/edge_fit.h"
#include "calib/pose/edge_scatter.h"
#include "calib/pose/pose_prior.h"
#include "core/base/median.h"

namespace scattermeter::calib {
namespace {

constexpr double kPiecesPerWidth = 150.0;
constexpr double kOutlier = 6.0;
constexpr std::size_t kMinPieces = 10;
constexpr std::size_t kMinLines = 3;

EdgeFit fit_pose(const std::vector<EdgePoint>& points, const CameraIntrinsics& intrinsics,
                 const Rigid3d& pose, double robust_px) {
  EdgeFitOptions options;
  options.robust = true;
  options.robust_px = robust_px;
  options.free = pose_parameters();
  options.prior = loose_pose_prior(edge_parameters(points), pose.translation_mm.norm());
  return fit_edges(points, intrinsics, pose, options);
}

std::size_t line_count(const std::vector<EdgePoint>& points) {
  std::set<std::pair<int, int>> lines;
  for (const EdgePoint& p : points) lines.insert({p.body_idx, p.line_idx});
  return lines.size();
}

// Nothing confirms a piece that is alone on its line, and with few lines the pose would follow it.
std::vector<EdgePoint> without_lone_pieces(const std::vector<EdgePoint>& points) {
  std::map<std::pair<int, int>, int> pieces;
  for (const EdgePoint& p : points) ++pieces[{p.body_idx, p.line_idx}];
  std::vector<EdgePoint> out;
  for (const EdgePoint& p : points) {
    if (pieces[{p.body_idx, p.line_idx}] > 1) out.push_back(p);
  }
  return out;
}

bool too_few(const std::vector<EdgePoint>& points) {
  return points.size() < kMinPieces || line_count(points) < kMinLines;
}

// The points within a few px and a cell of their position predicted by the pose.
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

Silhouette too_few_pieces() {
  return failed(SilhouetteStatus::kTooFewPieces,
                "too few lit straight edges of the body's outline are found: a darker background, "
                "longer exposure, or light from another side");
}

// Step (2) of find_silhouette(): the pose and the pieces located with it.
class FineSearch {
 public:
  FineSearch(const std::vector<EdgeShot>& shots, const CameraIntrinsics& intrinsics,
             const Rigid3d& given, const Rigid3d& start, const SilhouetteOptions& options)
      : shots_(shots),
        intrinsics_(intrinsics),
        given_(given),
        pose_(start),
        pose_is_near_(options.pose_is_near),
        may_lack_parts_(options.pose_is_near || options.may_lack_parts) {}

  // From cells of `coarse_px` down to the raw samples; false if there are too few pieces.
  bool run(int coarse_px) {
    bool found = settle(coarse_px, 2.5, 3.0, 3) || may_lack_parts_;
    for (int factor = coarse_px / 2; found && factor >= 2; factor /= 2) {
      found = settle(factor, 2.0, 4.0, 2) || may_lack_parts_;
    }
    return found && settle(1, 2.0, 5.0, 1) && settle(1, 1.0, 5.0, 1);
  }

  const Rigid3d& pose() const { return pose_; }
  const std::vector<EdgePoint>& points() const { return points_; }

 private:
  // Pieces and pose on cells of `factor` samples, repeated `times` times.
  bool settle(int factor, double search_px, double half_width_px, int times) {
    for (int i = 0; i < times; ++i) {
      EdgePointOptions o;
      o.factor = factor;
      o.search_px = search_px;
      o.half_width_px = half_width_px;
      o.piece_px = std::max(o.piece_px, intrinsics_.width_px / factor / kPiecesPerWidth);
      points_ = edge_points(shots_, intrinsics_, pose_, o);
      if (pose_is_near_) points_ = near(points_, intrinsics_, given_, factor);
      points_ = without_lone_pieces(points_);
      if (too_few(points_)) return false;
      const EdgeFit f = fit_pose(points_, intrinsics_, pose_, 0.3 * factor);
      if (!f.converged) return false;
      pose_ = f.camera_from_world;
    }
    return true;
  }

  const std::vector<EdgeShot>& shots_;
  const CameraIntrinsics& intrinsics_;
  const Rigid3d& given_;
  Rigid3d pose_;
  bool pose_is_near_, may_lack_parts_;
  std::vector<EdgePoint> points_;
};

// Points within kOutlier robust deviations of the best pose.
std::vector<EdgePoint> without_outliers(const std::vector<EdgePoint>& points,
                                        const CameraIntrinsics& intrinsics, const Rigid3d& pose) {
  const EdgeFit f = fit_pose(points, intrinsics, pose, 0.1);
  const double deviation = std::max(robust_deviation(f.residual_px), 0.005);
  std::vector<EdgePoint> kept;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (std::abs(f.residual_px[i]) <= kOutlier * std::hypot(deviation, points[i].std_px)) {
      kept.push_back(points[i]);
    }
  }
  return kept;
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
      options.search * intrinsics.width_px + 12 * coarse_cell_px(intrinsics.width_px);
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
  Rigid3d start = camera_from_world;
  // (1)
  if (!options.pose_is_near) {
    const auto turned = turn_coarsely(shots, intrinsics, camera_from_world, options.search);
    if (!turned) {
      return failed(SilhouetteStatus::kNotFound,
                    "the body's outline is not seen against a darker background near where pose "
                    "and mesh put it: look at pose, mesh and shots");
    }
    start = *turned;
  }
  // (2)
  FineSearch search(shots, intrinsics, camera_from_world, start, options);
  if (!search.run(coarse_cell_px(intrinsics.width_px))) return too_few_pieces();
  // (3)
  const Rigid3d& pose = search.pose();
  Silhouette out;
  out.points = without_outliers(search.points(), intrinsics, pose);
  out.pieces_left_out = search.points().size() - out.points.size();
  if (too_few(out.points)) return too_few_pieces();
  EdgeFitOptions fit;
  fit.free = pose_parameters();
  fit.prior = loose_pose_prior(edge_parameters(out.points), pose.translation_mm.norm());
  const EdgeScatter scatter = edge_scatter(out.points, intrinsics, pose, fit, options.line_std_px);
  out.line_std_px = fit.line_std_px = scatter.line_std_px;
  out.piece_std_px = fit.piece_std_px = scatter.piece_std_px;
  const EdgeFit f = fit_edges(out.points, intrinsics, pose, fit);
  const double worst_rad = std::sqrt(f.covariance.block<3, 3>(0, 0).trace());
  const double worst_mm = std::sqrt(f.covariance.block<3, 3>(3, 3).trace());
  if (!f.converged || !(worst_rad < 0.05) || !(worst_mm < 0.05 * pose.translation_mm.norm())) {
    return failed(SilhouetteStatus::kIllConditioned,
                  "the edges that are found do not determine the pose: more of the outline must be "
                  "lit");
  }
  out.status = SilhouetteStatus::kOk;
  out.camera_from_world = f.camera_from_world;
  const std::vector<double> given =
      edge_residuals_px(out.points, intrinsics, camera_from_world,
                        Eigen::VectorXd::Zero(edge_parameters(out.points)));
  for (std::size_t i = 0; i < out.points.size(); ++i) out.points[i].offset_px = given[i];
  return out;
}

}  // namespace scattermeter::calib
