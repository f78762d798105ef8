#include "calib/led/plane_cells.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <Eigen/Cholesky>
#include <oneapi/tbb/parallel_for.h>

#include "core/base/median.h"

namespace scattermeter::calib {
namespace {

constexpr double kSpotStds = 5.0;
constexpr double kStuckShare = 0.005;  // of a cell's samples that may be clipped: stuck ones
constexpr std::size_t kLeastSamples = 12;
// The floor lies four deviations of the read noise up; normal noise cut at its mean of 0 has a mean
// of 1 / sqrt(2 pi) of its deviation.
constexpr double kCutNoise = 0.3989 / 4.0;

struct PlaneSample {
  float x_mm, y_mm, signal, variance;
};

// The mean of the samples without spots; `kept` says which.
struct CellMean {
  Eigen::Vector2d place;
  Eigen::Matrix2d spread;
  double signal, variance;
  std::size_t spots;
};

std::optional<CellMean> robust_mean(const std::vector<PlaneSample>& samples, double max_left_out) {
  std::vector<bool> kept(samples.size(), true);
  CellMean mean{};
  for (int round = 0; round < 5; ++round) {
    double n = 0.0;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double variance = 0.0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      if (!kept[i]) continue;
      n += 1.0;
      sum += Eigen::Vector3d(samples[i].x_mm, samples[i].y_mm, samples[i].signal);
      variance += samples[i].variance;
    }
    if (n < kLeastSamples || n < (1.0 - max_left_out) * static_cast<double>(samples.size())) {
      return std::nullopt;
    }
    sum /= n;
    Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
    Eigen::Vector2d slope_sum = Eigen::Vector2d::Zero();
    for (std::size_t i = 0; i < samples.size(); ++i) {
      if (!kept[i]) continue;
      const Eigen::Vector2d d(samples[i].x_mm - sum.x(), samples[i].y_mm - sum.y());
      spread += d * d.transpose() / n;
      slope_sum += d * ((samples[i].signal - sum.z()) / n);
    }
    const Eigen::Vector2d slope = spread.ldlt().solve(slope_sum);
    if (!slope.allFinite()) return std::nullopt;
    const std::size_t spots = static_cast<std::size_t>(std::count(kept.begin(), kept.end(), false));
    // Unweighted: a sample's own variance follows its noise, and weights made of it pull the mean.
    mean = {sum.head<2>(), spread, sum.z(), variance / (n * n), spots};
    std::vector<double> residuals;
    for (const PlaneSample& s : samples) {
      residuals.push_back(s.signal - sum.z() -
                          slope.dot(Eigen::Vector2d(s.x_mm - sum.x(), s.y_mm - sum.y())));
    }
    const double limit =
        kSpotStds *
        std::max(std::sqrt(variance / n), kStdPerMad * median_absolute_deviation(residuals, 0.0));
    bool changed = false;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const bool keep = std::abs(residuals[i]) <= limit;
      changed = changed || keep != kept[i];
      kept[i] = keep;
    }
    if (!changed) break;
  }
  return mean;
}

std::vector<Eigen::Vector3d> outline(const WhitePlane& plane, int per_side) {
  std::vector<Eigen::Vector3d> points;
  const Eigen::Vector3d x = plane.width_mm * plane.x_axis;
  const Eigen::Vector3d y = plane.height_mm * plane.y_axis;
  for (int k = 0; k < per_side; ++k) {
    const double t = static_cast<double>(k) / per_side;
    for (const Eigen::Vector3d& p :
         {Eigen::Vector3d(t * x), Eigen::Vector3d(x + t * y), Eigen::Vector3d((1.0 - t) * x + y),
          Eigen::Vector3d((1.0 - t) * y)}) {
      points.push_back(plane.origin_mm + p);
    }
  }
  return points;
}

}  // namespace

PlaneImage plane_image(const CameraIntrinsics& intrinsics, const Rigid3d& camera_from_world,
                       const WhitePlane& plane) {
  PlaneImage image;
  const Eigen::Vector3d eye = inverse(camera_from_world).translation_mm;
  if (!(plane.normal().dot(eye - plane.origin_mm) > 0.0)) return image;
  const std::vector<Eigen::Vector3d> points = outline(plane, 8);
  double x_min = 1e30, y_min = 1e30, x_max = -1e30, y_max = -1e30;
  bool any = false;
  for (const Eigen::Vector2d& p : project(intrinsics, camera_from_world, points)) {
    // Parts without an image are out of the frame: the plane is then cut by the frame's edges.
    if (!p.allFinite()) {
      x_min = y_min = 0.0;
      x_max = intrinsics.width_px;
      y_max = intrinsics.height_px;
      continue;
    }
    any = true;
    x_min = std::min(x_min, p.x());
    x_max = std::max(x_max, p.x());
    y_min = std::min(y_min, p.y());
    y_max = std::max(y_max, p.y());
  }
  if (!any || !(x_max > 0.0) || !(y_max > 0.0) || !(x_min < intrinsics.width_px) ||
      !(y_min < intrinsics.height_px)) {
    return image;
  }
  image.x0 = std::max(0, static_cast<int>(std::floor(x_min))) & ~1;
  image.y0 = std::max(0, static_cast<int>(std::floor(y_min))) & ~1;
  image.width = std::min(intrinsics.width_px, static_cast<int>(std::ceil(x_max)) + 1) - image.x0;
  image.height = std::min(intrinsics.height_px, static_cast<int>(std::ceil(y_max)) + 1) - image.y0;
  for (const Eigen::Vector3d& p : outline(plane, 1)) {
    const double range = (p - eye).norm();
    const double cosine = plane.normal().dot(eye - p) / range;
    image.mm_per_px =
        std::max(image.mm_per_px, range / std::min(intrinsics.fx_px, intrinsics.fy_px) / cosine);
  }
  return image;
}

PlaneCells plane_cells(const CfaSamples& samples, const CameraIntrinsics& intrinsics,
                       const Rigid3d& camera_from_world, const WhitePlane& plane,
                       const std::array<double, 3>& responsivity, std::size_t view_idx,
                       std::size_t plane_idx, const PlaneCellOptions& options) {
  PlaneCells out;
  const PlaneImage image = plane_image(intrinsics, camera_from_world, plane);
  const double margin = options.border_px * image.mm_per_px;
  const double width = plane.width_mm - 2.0 * margin;
  const double height = plane.height_mm - 2.0 * margin;
  if (image.width <= 0 || !(width > 0.0) || !(height > 0.0)) return out;
  const double edge = std::max(std::max(width, height) / options.cells_across,
                               options.min_cell_px * image.mm_per_px);
  out.columns = std::max(1, static_cast<int>(std::lround(width / edge)));
  out.rows = std::max(1, static_cast<int>(std::lround(height / edge)));

  const Eigen::Vector3d eye = inverse(camera_from_world).translation_mm;
  const Eigen::Matrix3d world_from_camera =
      camera_from_world.rotation.conjugate().toRotationMatrix();
  const std::vector<Eigen::Vector3f> rays =
      pixel_rays_in_camera(intrinsics, samples.x0, samples.y0, samples.width, samples.height);
  const std::size_t n_cells =
      static_cast<std::size_t>(out.columns) * static_cast<std::size_t>(out.rows);
  std::vector<std::vector<PlaneSample>> bins(3 * n_cells);
  std::vector<std::size_t> clipped(3 * n_cells, 0);
  for (int y = 0; y < samples.height; ++y) {
    for (int x = 0; x < samples.width; ++x) {
      const std::size_t at = static_cast<std::size_t>(y) * static_cast<std::size_t>(samples.width) +
                             static_cast<std::size_t>(x);
      const Eigen::Vector3d ray = rays[at].cast<double>();
      if (!ray.allFinite()) continue;
      const auto p = plane.meet_mm(eye, world_from_camera * ray);
      if (!p) continue;
      const double u = (p->x() - margin) / width * out.columns;
      const double v = (p->y() - margin) / height * out.rows;
      if (!(u >= 0.0) || !(v >= 0.0) || !(u < out.columns) || !(v < out.rows)) continue;
      const std::size_t bin =
          3 * (static_cast<std::size_t>(v) * static_cast<std::size_t>(out.columns) +
               static_cast<std::size_t>(u)) +
          static_cast<std::size_t>(samples.channel(samples.x0 + x, samples.y0 + y));
      if (samples.clipped[at] != 0) {
        ++clipped[bin];
        continue;
      }
      bins[bin].push_back({static_cast<float>(p->x()), static_cast<float>(p->y()),
                           samples.signal_counts[at], samples.variance_counts2[at]});
    }
  }
  std::vector<std::optional<CellMean>> means(bins.size());
  std::vector<char> is_clipped(bins.size(), 0);
  tbb::parallel_for(std::size_t{0}, bins.size(), [&](std::size_t b) {
    const double all = static_cast<double>(bins[b].size() + clipped[b]);
    if (static_cast<double>(clipped[b]) > kStuckShare * all) {
      is_clipped[b] = 1;
      return;
    }
    if (bins[b].size() < kLeastSamples) return;
    means[b] = robust_mean(bins[b], options.max_left_out);
    if (!means[b] || !(means[b]->signal < samples.floor_counts)) return;
    if (options.keep_faint) {
      means[b]->variance += std::pow(kCutNoise * samples.floor_counts, 2);
    } else {
      means[b].reset();
    }
  });
  for (std::size_t b = 0; b < bins.size(); ++b) {
    out.clipped_cells += static_cast<std::size_t>(is_clipped[b]);
    if (!means[b]) continue;
    out.spots += means[b]->spots + clipped[b];
    ShadedCell cell;
    cell.view = view_idx;
    cell.plane = plane_idx;
    cell.channel = static_cast<int>(b % 3);
    cell.column = static_cast<int>(b / 3 % static_cast<std::size_t>(out.columns));
    cell.row = static_cast<int>(b / 3 / static_cast<std::size_t>(out.columns));
    cell.place_mm = means[b]->place;
    cell.spread_mm2 = means[b]->spread;
    const double per_count = 1.0 / (samples.exposure_s * responsivity[b % 3]);
    cell.radiance_W_per_mm2_sr = means[b]->signal * per_count;
    cell.std_W_per_mm2_sr = std::sqrt(means[b]->variance) * per_count;
    out.cells.push_back(cell);
  }
  return out;
}

}  // namespace scattermeter::calib
