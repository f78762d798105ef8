#include "calib/led/highlight.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "core/base/median.h"
#include "core/camera/lens.h"

namespace scattermeter::calib {
namespace {

constexpr double kFoot = 0.1;  // of the peak: where a blob ends

// Sums over 2 x 2 cells of the filter array: any blob shows there whatever its colour.
struct CellSums {
  int width, height;
  std::vector<double> sum;
  double at(int i, int j) const {
    return sum[static_cast<std::size_t>(j) * static_cast<std::size_t>(width) +
               static_cast<std::size_t>(i)];
  }
};

CellSums cell_sums(const CfaSamples& s) {
  CellSums cells{s.width / 2, s.height / 2, {}};
  for (int j = 0; j < cells.height; ++j) {
    for (int i = 0; i < cells.width; ++i) {
      double sum = 0.0;
      for (int k = 0; k < 4; ++k) {
        sum += s.signal_counts[static_cast<std::size_t>(2 * j + k / 2) *
                                   static_cast<std::size_t>(s.width) +
                               static_cast<std::size_t>(2 * i + k % 2)];
      }
      cells.sum.push_back(sum);
    }
  }
  return cells;
}

struct Blob {
  int low_x = 0, high_x = 0, low_y = 0, high_y = 0;  // samples of the rectangle, inclusive
  std::size_t cells = 0;
  bool touches_rim = false;
};

// The cells above `foot` that hang together with the one at (i, j).
Blob grow(const CellSums& cells, const std::vector<bool>& on_disc, int i, int j, double foot) {
  Blob blob{2 * i, 2 * i + 1, 2 * j, 2 * j + 1};
  std::vector<bool> seen(cells.sum.size(), false);
  std::vector<std::pair<int, int>> open = {{i, j}};
  const auto index = [&](int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(cells.width) +
           static_cast<std::size_t>(x);
  };
  seen[index(i, j)] = true;
  while (!open.empty()) {
    const auto [x, y] = open.back();
    open.pop_back();
    ++blob.cells;
    blob.low_x = std::min(blob.low_x, 2 * x);
    blob.high_x = std::max(blob.high_x, 2 * x + 1);
    blob.low_y = std::min(blob.low_y, 2 * y);
    blob.high_y = std::max(blob.high_y, 2 * y + 1);
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const int xx = x + dx;
        const int yy = y + dy;
        if (xx < 0 || yy < 0 || xx >= cells.width || yy >= cells.height ||
            !on_disc[index(xx, yy)]) {
          blob.touches_rim = true;
          continue;
        }
        if (seen[index(xx, yy)] || !(cells.at(xx, yy) > foot)) continue;
        seen[index(xx, yy)] = true;
        open.emplace_back(xx, yy);
      }
    }
  }
  return blob;
}

struct PhaseSums {
  double w = 0, wx = 0, wy = 0;  // of signal above the surroundings
  double vx = 0, vy = 0;         // variance of wx, wy about the centre
  double noise2 = 0;
};

}  // namespace

SphereImage sphere_image(const CameraIntrinsics& intrinsics, const Rigid3d& camera_from_world,
                         const MirrorSphere& sphere) {
  constexpr int kSides = 48;
  constexpr int kMargin = 4;
  SphereImage image;
  const Lens lens(intrinsics);
  const Eigen::Vector3d c = camera_from_world * sphere.center_mm;
  const double distance = c.norm();
  if (!(distance > sphere.radius_mm) || !(c.z() > 0.0)) return image;
  // The outline: the circle of the points where rays touch the sphere.
  const Eigen::Vector3d axis = c / distance;
  const double sine = sphere.radius_mm / distance;
  const Eigen::Vector3d foot = c - sphere.radius_mm * sine * axis;
  const double ring_mm = sphere.radius_mm * std::sqrt(1.0 - sine * sine);
  const Eigen::Vector3d u = axis.unitOrthogonal();
  const Eigen::Vector3d v = axis.cross(u);
  image.center_px = lens.project(c);
  if (!image.center_px.allFinite()) return image;
  double x_min = 1e30, y_min = 1e30, x_max = -1e30, y_max = -1e30;
  image.radius_px = std::numeric_limits<double>::infinity();
  for (int k = 0; k < kSides; ++k) {
    const double t = 2.0 * M_PI * k / kSides;
    const Eigen::Vector2d p = lens.project(foot + ring_mm * (std::cos(t) * u + std::sin(t) * v));
    if (!p.allFinite()) return image;
    x_min = std::min(x_min, p.x());
    x_max = std::max(x_max, p.x());
    y_min = std::min(y_min, p.y());
    y_max = std::max(y_max, p.y());
    image.radius_px = std::min(image.radius_px, (p - image.center_px).norm());
  }
  if (!(x_max > 0.0) || !(y_max > 0.0) || !(x_min < intrinsics.width_px) ||
      !(y_min < intrinsics.height_px)) {
    return image;
  }
  image.x0 = std::max(0, static_cast<int>(std::floor(x_min)) - kMargin) & ~1;
  image.y0 = std::max(0, static_cast<int>(std::floor(y_min)) - kMargin) & ~1;
  image.width =
      (std::min(intrinsics.width_px, static_cast<int>(std::ceil(x_max)) + kMargin) - image.x0) & ~1;
  image.height =
      (std::min(intrinsics.height_px, static_cast<int>(std::ceil(y_max)) + kMargin) - image.y0) &
      ~1;
  if (image.width < 4 || image.height < 4) image.width = image.height = 0;
  return image;
}

FoundHighlight find_highlight(const CfaSamples& s, const SphereImage& sphere,
                              const HighlightOptions& options) {
  FoundHighlight found;
  found.image_px.setConstant(std::numeric_limits<double>::quiet_NaN());
  if (s.width < 4 || s.height < 4) {
    found.problem = "the sphere is out of view";
    return found;
  }
  const CellSums cells = cell_sums(s);
  std::vector<bool> on_disc;
  std::vector<double> values;
  std::size_t best = 0;
  double peak = -std::numeric_limits<double>::infinity();
  for (int j = 0; j < cells.height; ++j) {
    for (int i = 0; i < cells.width; ++i) {
      const Eigen::Vector2d p(s.x0 + 2 * i + 0.5, s.y0 + 2 * j + 0.5);
      const bool inside = (p - sphere.center_px).norm() < sphere.radius_px;
      on_disc.push_back(inside);
      if (!inside) continue;
      values.push_back(cells.at(i, j));
      if (values.back() > peak) {
        peak = values.back();
        best = on_disc.size() - 1;
      }
    }
  }
  if (values.size() < 16) {
    found.problem = "the sphere is too small in the frame, or out of it";
    return found;
  }
  const double disc_cells = static_cast<double>(values.size());
  const double base = upper_median(values);
  for (double& v : values) v = std::abs(v - base);
  double noise2 = 0.0;
  for (float v : s.variance_counts2) noise2 += v;
  noise2 *= 4.0 / static_cast<double>(s.variance_counts2.size());
  const double scatter = std::max(kStdPerMad * upper_median(values), std::sqrt(noise2));
  if (!(peak - base > options.min_snr * scatter)) {
    found.problem = "no highlight on the sphere: is it hidden, or the LED off?";
    return found;
  }
  const int bi = static_cast<int>(best) % cells.width;
  const int bj = static_cast<int>(best) / cells.width;
  const Blob blob = grow(cells, on_disc, bi, bj, base + kFoot * (peak - base));
  if (static_cast<double>(blob.cells) > options.max_share * disc_cells) {
    found.problem = "the bright part of the sphere is no compact highlight";
    return found;
  }
  if (blob.touches_rim) {
    found.problem = "the highlight lies at the rim of the sphere";
    return found;
  }
  found.width_px = std::max(blob.high_x - blob.low_x, blob.high_y - blob.low_y) + 1;
  // Its surroundings: a window of twice its size and more, as far as the sphere goes.
  const double half = found.width_px / 2.0 + 6.0;
  Eigen::Vector2d center(s.x0 + 0.5 * (blob.low_x + blob.high_x),
                         s.y0 + 0.5 * (blob.low_y + blob.high_y));
  std::array<PhaseSums, 4> sums;
  std::array<double, 4> level{};
  std::size_t saturated = 0, in_blob = 0;
  // The window is centred on the blob, so that what stays of the surroundings pulls nowhere.
  for (int round = 0; round < 4; ++round) {
    sums = {};
    saturated = in_blob = 0;
    std::array<std::vector<double>, 4> around;
    const auto each = [&](const auto& visit) {
      const int reach = static_cast<int>(std::ceil(half)) + 4;
      const int cx = static_cast<int>(std::lround(center.x())) - s.x0;
      const int cy = static_cast<int>(std::lround(center.y())) - s.y0;
      for (int y = std::max(0, cy - reach); y < std::min(s.height, cy + reach + 1); ++y) {
        for (int x = std::max(0, cx - reach); x < std::min(s.width, cx + reach + 1); ++x) {
          const Eigen::Vector2d p(s.x0 + x, s.y0 + y);
          visit(p, static_cast<std::size_t>(y) * static_cast<std::size_t>(s.width) +
                       static_cast<std::size_t>(x));
        }
      }
    };
    each([&](const Eigen::Vector2d& p, std::size_t at) {
      const double r = (p - center).norm();
      if (r > half - 2.0 && r < half + 3.0) {
        around[cfa_phase(static_cast<int>(p.x()), static_cast<int>(p.y()))].push_back(
            s.signal_counts[at]);
      }
    });
    for (std::size_t k = 0; k < 4; ++k)
      level[k] = around[k].empty() ? 0.0 : upper_median(around[k]);
    each([&](const Eigen::Vector2d& p, std::size_t at) {
      const double r = (p - center).norm();
      // Samples fade out over the last one of the window: none enters or leaves as a whole.
      const double taper = std::clamp(half + 0.5 - r, 0.0, 1.0);
      if (taper == 0.0) return;
      const std::size_t k = cfa_phase(static_cast<int>(p.x()), static_cast<int>(p.y()));
      const double w = taper * (s.signal_counts[at] - level[k]);
      PhaseSums& sum = sums[k];
      sum.w += w;
      sum.wx += w * (p.x() - center.x());
      sum.wy += w * (p.y() - center.y());
      const double var = taper * taper * s.variance_counts2[at];
      sum.vx += var * (p.x() - center.x()) * (p.x() - center.x());
      sum.vy += var * (p.y() - center.y()) * (p.y() - center.y());
      sum.noise2 += var;
      if (r < 0.5 * found.width_px) {
        ++in_blob;
        saturated += s.clipped[at];
      }
    });
    Eigen::Vector2d mean = Eigen::Vector2d::Zero();
    Eigen::Vector2d variance = Eigen::Vector2d::Zero();
    double phases = 0.0;
    for (const PhaseSums& sum : sums) {
      if (!(sum.w > options.min_snr * std::sqrt(sum.noise2))) continue;
      phases += 1.0;
      mean += Eigen::Vector2d(sum.wx, sum.wy) / sum.w;
      variance += Eigen::Vector2d(sum.vx, sum.vy) / (sum.w * sum.w);
    }
    if (phases == 0.0) {
      found.problem = "the highlight is too weak";
      return found;
    }
    mean /= phases;
    variance /= phases * phases;
    if (mean.norm() > half) {
      found.problem = "no compact highlight on the sphere";
      return found;
    }
    center += mean;
    found.std_px = std::sqrt(0.5 * variance.sum() + options.model_std_px * options.model_std_px);
  }
  found.image_px = center;
  found.saturated_share =
      in_blob > 0 ? static_cast<double>(saturated) / static_cast<double>(in_blob) : 0.0;
  return found;
}

}  // namespace scattermeter::calib
