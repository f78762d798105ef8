#include "calib/pose/coarse_turn.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "calib/pose/cell_means.h"
#include "core/camera/lens.h"
#include "core/mesh/visible_edges.h"

namespace scattermeter::calib {
namespace {

constexpr int kCoarseWidth = 260;  // most cells in the width
constexpr double kBesideCells = 1.5;
constexpr double kMinContrast = 0.25;

// Signal and noise at a position between samples: bilinear interpolation of the four around it; no
// signal outside the picture.
struct Interpolated {
  double signal;
  double noise;
};
Interpolated interpolate(const CfaSamples& s, const Eigen::Vector2d& at) {
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

struct ContourPiece {
  std::size_t shot;
  Eigen::Vector2d at_px;
  Eigen::Vector2d at_cell;
  Eigen::Vector2d outward;
};

std::vector<ContourPiece> contour_pieces(const std::vector<EdgeShot>& shots, const Lens& lens,
                                         double fx_px, int factor,
                                         const Rigid3d& camera_from_world) {
  VisibleEdgesOptions seen;
  seen.step_rad = 6.0 * factor / fx_px;
  const Eigen::Vector3d eye_mm = inverse(camera_from_world).translation_mm;
  const auto px = [&](const Eigen::Vector3d& x) { return lens.project(camera_from_world * x); };
  std::vector<ContourPiece> pieces;
  for (std::size_t i = 0; i < shots.size(); ++i) {
    for (const EdgePiece& piece : visible_edges(*shots[i].scene, eye_mm, seen)) {
      if (piece.kind != EdgeKind::kContour) continue;
      const Eigen::Vector2d at = px(piece.center_mm);
      const Eigen::Vector2d along = px(piece.center_mm + piece.half_mm) - at;
      const Eigen::Vector2d aside =
          px(piece.center_mm + 0.01 * piece.half_mm.norm() * piece.outward) - at;
      if (!at.allFinite() || !along.allFinite() || !aside.allFinite()) continue;
      Eigen::Vector2d outward = Eigen::Vector2d(-along.y(), along.x()).normalized();
      if (!outward.allFinite()) continue;
      if (outward.dot(aside) < 0) outward = -outward;
      pieces.push_back({i, at, (at.array() + 0.5) / factor - 0.5, outward});
    }
  }
  return pieces;
}

// Mean contrast across the pieces after a shift of all by `shift` cells.
double mean_contrast(const std::vector<ContourPiece>& pieces, const std::vector<CfaSamples>& cells,
                     const Eigen::Vector2d& shift) {
  double sum = 0;
  for (const ContourPiece& p : pieces) {
    const Eigen::Vector2d at = p.at_cell + shift;
    const Interpolated in = interpolate(cells[p.shot], at - kBesideCells * p.outward);
    const Interpolated out = interpolate(cells[p.shot], at + kBesideCells * p.outward);
    const double level = std::abs(in.signal) + std::abs(out.signal) + 4 * (in.noise + out.noise);
    sum += (in.signal - out.signal) / std::max(level, 1e-12);
  }
  return sum / static_cast<double>(pieces.size());
}

}  // namespace

int coarse_cell_px(int width_px) {
  int factor = 2;
  while (width_px / factor > kCoarseWidth) factor *= 2;
  return factor;
}

std::optional<Rigid3d> turn_coarsely(const std::vector<EdgeShot>& shots,
                                     const CameraIntrinsics& intrinsics,
                                     const Rigid3d& camera_from_world, double search) {
  const int factor = coarse_cell_px(intrinsics.width_px);
  std::vector<CfaSamples> cells;
  for (const EdgeShot& shot : shots) cells.push_back(cell_means(shot.samples, factor));
  const Lens lens(intrinsics);
  const std::vector<ContourPiece> pieces =
      contour_pieces(shots, lens, intrinsics.fx_px, factor, camera_from_world);
  if (pieces.empty()) return std::nullopt;
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  for (const ContourPiece& p : pieces) middle += p.at_px;
  middle /= static_cast<double>(pieces.size());
  const int reach = std::max(2, static_cast<int>(std::ceil(search * intrinsics.width_px / factor)));
  double best = -1;
  Eigen::Vector2d shift = Eigen::Vector2d::Zero();
  for (int dy = -reach; dy <= reach; ++dy) {
    for (int dx = -reach; dx <= reach; ++dx) {
      const double contrast = mean_contrast(pieces, cells, Eigen::Vector2d(dx, dy));
      if (contrast > best) {
        best = contrast;
        shift = Eigen::Vector2d(dx, dy);
      }
    }
  }
  if (best < kMinContrast || shift.cwiseAbs().maxCoeff() >= reach) return std::nullopt;
  const Eigen::Vector3d from = lens.unproject(middle).homogeneous();
  const Eigen::Vector3d to = lens.unproject(middle + factor * shift).homogeneous();
  if (!from.allFinite() || !to.allFinite()) return std::nullopt;
  const Eigen::Vector3d axis = from.cross(to);
  if (axis.isZero(0.0)) return camera_from_world;
  const Eigen::AngleAxisd turn(std::atan2(axis.norm(), from.dot(to)), axis.normalized());
  return Rigid3d{Eigen::Quaterniond(turn), Eigen::Vector3d::Zero()} * camera_from_world;
}

}  // namespace scattermeter::calib
