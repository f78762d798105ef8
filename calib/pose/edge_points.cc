#include "calib/pose/edge_points.h"

#include <algorithm>
#include <optional>
#include <span>

#include <oneapi/tbb/parallel_for.h>

#include "calib/pose/blur_across.h"
#include "calib/pose/cell_means.h"
#include "calib/pose/edge_strip.h"
#include "core/base/median.h"
#include "core/camera/lens.h"

namespace scattermeter::calib {
namespace {

constexpr double kMinPiece = 3.0;  // cells
// Strips from which the blur is estimated: at least, and at most tried.
constexpr std::size_t kBlurSample = 15;
constexpr std::size_t kBlurTries = 64;

struct Candidate {
  EdgePoint point;
  Eigen::Vector2d at_cell;  // predicted
  double half_length_cells;
};

// Cell (0, 0) of `factor` samples is centred at (factor - 1) / 2.
Eigen::Vector2d cell_of(const Eigen::Vector2d& px, int factor) {
  return (px.array() + 0.5) / factor - 0.5;
}

std::vector<Candidate> predict(std::span<const EdgeShot> shots, const Lens& lens, double fx_px,
                               const Rigid3d& camera_from_world, const EdgePointOptions& options) {
  VisibleEdgesOptions seen;
  seen.step_rad = options.piece_px * options.factor / fx_px;
  seen.clearance_rad = (options.half_width_px + options.search_px) * options.factor / fx_px;
  const Eigen::Vector3d eye_mm = inverse(camera_from_world).translation_mm;
  std::vector<Candidate> out;
  for (std::size_t i = 0; i < shots.size(); ++i) {
    for (const EdgePiece& piece : visible_edges(*shots[i].scene, eye_mm, seen)) {
      if (piece.kind == EdgeKind::kCrease) continue;
      const auto px = [&](const Eigen::Vector3d& x) { return lens.project(camera_from_world * x); };
      const Eigen::Vector2d at = px(piece.center_mm);
      const Eigen::Vector2d along =
          0.5 * (px(piece.center_mm + piece.half_mm) - px(piece.center_mm - piece.half_mm));
      const Eigen::Vector2d aside =
          px(piece.center_mm + 0.01 * piece.half_mm.norm() * piece.outward) - at;
      const double half_cells = along.norm() / options.factor;
      if (!(2 * half_cells >= kMinPiece) || !aside.allFinite()) continue;
      Candidate c;
      c.point.shot_idx = static_cast<int>(i);
      c.point.body_idx = shots[i].body_idx;
      c.point.line_idx = piece.line_idx;
      c.point.line_end_mm = piece.line_end_mm;
      c.point.kind = piece.kind;
      c.point.point_mm = piece.center_mm;
      c.point.tangent = piece.half_mm.normalized();
      c.point.measured_px = at;
      c.point.outward = Eigen::Vector2d(-along.y(), along.x()).normalized();
      if (c.point.outward.dot(aside) < 0) c.point.outward = -c.point.outward;
      c.at_cell = cell_of(at, options.factor);
      c.half_length_cells = half_cells;
      out.push_back(c);
    }
  }
  return out;
}

EdgeStripOptions strip_of(const Candidate& candidate, const EdgePointOptions& options) {
  EdgeStripOptions strip;
  strip.half_length_px = candidate.half_length_cells;
  strip.half_width_px = options.half_width_px;
  strip.search_px = options.search_px;
  strip.both_bright = candidate.point.kind == EdgeKind::kStep;
  return strip;
}

std::vector<double> blurs_of(const std::vector<EdgeStrip>& strips) {
  std::vector<double> out;
  for (const EdgeStrip& s : strips) {
    if (s.found) out.push_back(s.blur_px);
  }
  return out;
}

}  // namespace

std::optional<Eigen::Matrix2d> edge_blur_px2(const EdgeShot& shot,
                                             const CameraIntrinsics& intrinsics,
                                             const Rigid3d& camera_from_world) {
  constexpr std::size_t kMostPieces = 24;
  EdgePointOptions options;
  options.half_width_px = 12.0;
  options.search_px = 8.0;
  std::vector<Candidate> candidates =
      predict({&shot, 1}, Lens(intrinsics), intrinsics.fx_px, camera_from_world, options);
  std::erase_if(candidates, [](const Candidate& c) { return c.point.kind != EdgeKind::kContour; });
  const std::size_t stride = 1 + candidates.size() / kMostPieces;
  std::vector<EdgeStrip> found((candidates.size() + stride - 1) / stride);
  tbb::parallel_for(std::size_t{0}, found.size(), [&](std::size_t i) {
    const Candidate& c = candidates[i * stride];
    EdgeStripOptions strip = strip_of(c, options);
    strip.max_blur_px = 6.0;
    found[i] = locate_edge(shot.samples, c.at_cell, c.point.outward, strip);
  });
  std::vector<BlurAcross> blurs;
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (found[i].found) {
      blurs.push_back({candidates[i * stride].point.outward, found[i].blur_px * found[i].blur_px});
    }
  }
  return point_spread_px2(blurs);
}

std::vector<EdgePoint> edge_points(const std::vector<EdgeShot>& shots,
                                   const CameraIntrinsics& intrinsics,
                                   const Rigid3d& camera_from_world,
                                   const EdgePointOptions& options) {
  const Lens lens(intrinsics);
  const std::vector<Candidate> candidates =
      predict(shots, lens, intrinsics.fx_px, camera_from_world, options);
  std::vector<CfaSamples> cells;
  if (options.factor > 1) {
    for (const EdgeShot& shot : shots) cells.push_back(cell_means(shot.samples, options.factor));
  }
  const auto locate = [&](std::size_t stride, std::optional<double> blur_px) {
    std::vector<EdgeStrip> found((candidates.size() + stride - 1) / stride);
    tbb::parallel_for(std::size_t{0}, found.size(), [&](std::size_t i) {
      const Candidate& c = candidates[stride * i];
      const auto shot = static_cast<std::size_t>(c.point.shot_idx);
      EdgeStripOptions strip = strip_of(c, options);
      strip.blur_px = blur_px;
      found[i] = locate_edge(options.factor > 1 ? cells[shot] : shots[shot].samples, c.at_cell,
                             c.point.outward, strip);
    });
    return found;
  };
  std::vector<double> blurs = blurs_of(locate(1 + candidates.size() / kBlurTries, std::nullopt));
  std::vector<EdgeStrip> found = locate(
      1, blurs.size() < kBlurSample ? std::nullopt : std::optional(upper_median(std::move(blurs))));
  std::vector<EdgePoint> out;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (!found[i].found || found[i].std_px > options.max_std_px) continue;
    EdgePoint p = candidates[i].point;
    p.offset_px = found[i].offset_px * options.factor;
    p.std_px = found[i].std_px * options.factor;
    p.measured_px += p.offset_px * p.outward;
    out.push_back(p);
  }
  return out;
}

}  // namespace scattermeter::calib
