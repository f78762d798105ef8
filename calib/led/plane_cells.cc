#include "calib/led/plane_cells.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <oneapi/tbb/parallel_for.h>

#include "calib/led/cell_mean.h"

namespace scattermeter::calib {
namespace {

constexpr double kStuckShare = 0.005;  // of a cell's samples that may be clipped: stuck pixels
// The floor is four standard deviations of the read noise above zero; normal noise cut at its mean
// of 0 has a mean of 1 / sqrt(2 pi) of its standard deviation.
constexpr double kCutNoise = 0.3989 / 4.0;

// The samples of each cell and channel, at index 3 (row columns + column) + channel.
struct CellBins {
  std::vector<std::vector<PlaneSample>> samples;
  std::vector<std::size_t> clipped;  // clipped samples, which are not in `samples`
};

// The grid of cells of a plane, `margin_mm` inside its edges.
struct PlaneGrid {
  double margin_mm, width_mm, height_mm;
  int columns, rows;
};

std::optional<PlaneGrid> grid_of(const WhitePlane& plane, const PlaneImage& image,
                                 const PlaneCellOptions& options) {
  const double margin = options.border_px * image.mm_per_px;
  const double width = plane.width_mm - 2.0 * margin;
  const double height = plane.height_mm - 2.0 * margin;
  if (image.width <= 0 || !(width > 0.0) || !(height > 0.0)) return std::nullopt;
  const double edge = std::max(std::max(width, height) / options.cells_across,
                               options.min_cell_px * image.mm_per_px);
  return PlaneGrid{margin, width, height, std::max(1, static_cast<int>(std::lround(width / edge))),
                   std::max(1, static_cast<int>(std::lround(height / edge)))};
}

CellBins bin_samples(const CfaSamples& samples, const CameraIntrinsics& intrinsics,
                     const Rigid3d& camera_from_world, const WhitePlane& plane,
                     const PlaneGrid& grid) {
  const Eigen::Vector3d eye = inverse(camera_from_world).translation_mm;
  const Eigen::Matrix3d world_from_camera =
      camera_from_world.rotation.conjugate().toRotationMatrix();
  const std::vector<Eigen::Vector3f> rays =
      pixel_rays_in_camera(intrinsics, samples.x0, samples.y0, samples.width, samples.height);
  const std::size_t n_cells =
      static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows);
  CellBins bins;
  bins.samples.resize(3 * n_cells);
  bins.clipped.assign(3 * n_cells, 0);
  for (int y = 0; y < samples.height; ++y) {
    for (int x = 0; x < samples.width; ++x) {
      const std::size_t at = static_cast<std::size_t>(y) * static_cast<std::size_t>(samples.width) +
                             static_cast<std::size_t>(x);
      const Eigen::Vector3d ray = rays[at].cast<double>();
      if (!ray.allFinite()) continue;
      const auto p = plane.meet_mm(eye, world_from_camera * ray);
      if (!p) continue;
      const double u = (p->x() - grid.margin_mm) / grid.width_mm * grid.columns;
      const double v = (p->y() - grid.margin_mm) / grid.height_mm * grid.rows;
      if (!(u >= 0.0) || !(v >= 0.0) || !(u < grid.columns) || !(v < grid.rows)) continue;
      const std::size_t bin =
          3 * (static_cast<std::size_t>(v) * static_cast<std::size_t>(grid.columns) +
               static_cast<std::size_t>(u)) +
          static_cast<std::size_t>(samples.channel(samples.x0 + x, samples.y0 + y));
      if (samples.clipped[at] != 0) {
        ++bins.clipped[bin];
        continue;
      }
      bins.samples[bin].push_back({static_cast<float>(p->x()), static_cast<float>(p->y()),
                                   samples.signal_counts[at], samples.variance_counts2[at]});
    }
  }
  return bins;
}

}  // namespace

PlaneCells plane_cells(const CfaSamples& samples, const CameraIntrinsics& intrinsics,
                       const Rigid3d& camera_from_world, const WhitePlane& plane,
                       const std::array<double, 3>& responsivity_counts_mm2_sr_per_W_s,
                       std::size_t view_idx, std::size_t plane_idx,
                       const PlaneCellOptions& options) {
  PlaneCells out;
  const auto grid = grid_of(plane, plane_image(intrinsics, camera_from_world, plane), options);
  if (!grid) return out;
  out.columns = grid->columns;
  out.rows = grid->rows;
  const CellBins bins = bin_samples(samples, intrinsics, camera_from_world, plane, *grid);
  std::vector<std::optional<CellMean>> means(bins.samples.size());
  std::vector<char> is_clipped(bins.samples.size(), 0);
  tbb::parallel_for(std::size_t{0}, means.size(), [&](std::size_t b) {
    const double all = static_cast<double>(bins.samples[b].size() + bins.clipped[b]);
    if (static_cast<double>(bins.clipped[b]) > kStuckShare * all) {
      is_clipped[b] = 1;
      return;
    }
    means[b] = robust_cell_mean(bins.samples[b], options.max_left_out);
    if (!means[b] || !(means[b]->signal_counts < samples.floor_counts)) return;
    if (options.keep_faint) {
      means[b]->variance_counts2 += std::pow(kCutNoise * samples.floor_counts, 2);
    } else {
      means[b].reset();
    }
  });
  for (std::size_t b = 0; b < means.size(); ++b) {
    out.clipped_cells += static_cast<std::size_t>(is_clipped[b]);
    if (!means[b]) continue;
    out.spots += means[b]->spots + bins.clipped[b];
    ShadedCell cell;
    cell.view = view_idx;
    cell.plane = plane_idx;
    cell.channel = static_cast<int>(b % 3);
    cell.column = static_cast<int>(b / 3 % static_cast<std::size_t>(out.columns));
    cell.row = static_cast<int>(b / 3 / static_cast<std::size_t>(out.columns));
    cell.on_plane_mm = means[b]->position_mm;
    cell.spread_mm2 = means[b]->spread_mm2;
    const double per_count = 1.0 / (samples.exposure_s * responsivity_counts_mm2_sr_per_W_s[b % 3]);
    cell.radiance_W_per_mm2_sr = means[b]->signal_counts * per_count;
    cell.std_W_per_mm2_sr = std::sqrt(means[b]->variance_counts2) * per_count;
    out.cells.push_back(cell);
  }
  return out;
}

}  // namespace scattermeter::calib
