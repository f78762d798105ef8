#include "calib/led/highlight.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "core/base/median.h"

namespace scattermeter::calib {
namespace {

constexpr double kFoot = 0.1;  // of the peak: the level at which a blob ends

// Sums over 2 x 2 cells of the filter array, in which a blob of any colour is visible.
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

// The cells above `foot` that are connected with the one at (i, j).
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

// The brightest cell on the disc of the sphere, and the level and scatter of the disc.
struct Peak {
  int i = 0, j = 0;           // of CellSums
  double value = 0;           // of that cell
  double base = 0;            // median cell of the disc
  double scatter = 0;         // robust standard deviation of the cells, at least the noise
  std::size_t n_cells = 0;    // of the disc
  std::vector<bool> on_disc;  // one per cell
};

Peak brightest_cell(const CfaSamples& s, const CellSums& cells, const SphereImage& sphere) {
  Peak peak;
  std::vector<double> values;
  peak.value = -std::numeric_limits<double>::infinity();
  for (int j = 0; j < cells.height; ++j) {
    for (int i = 0; i < cells.width; ++i) {
      const Eigen::Vector2d p(s.x0 + 2 * i + 0.5, s.y0 + 2 * j + 0.5);
      const bool inside = (p - sphere.center_px).norm() < sphere.radius_px;
      peak.on_disc.push_back(inside);
      if (!inside) continue;
      values.push_back(cells.at(i, j));
      if (values.back() > peak.value) {
        peak.value = values.back();
        peak.i = i;
        peak.j = j;
      }
    }
  }
  peak.n_cells = values.size();
  if (values.empty()) return peak;
  peak.base = upper_median(values);
  for (double& v : values) v = std::abs(v - peak.base);
  double noise2 = 0.0;
  for (float v : s.variance_counts2) noise2 += v;
  noise2 *= 4.0 / static_cast<double>(s.variance_counts2.size());
  peak.scatter = std::max(kStdPerMad * upper_median(values), std::sqrt(noise2));
  return peak;
}

struct PhaseSums {
  double w = 0, wx = 0, wy = 0;  // of signal above the surroundings
  double vx = 0, vy = 0;         // variance of wx, wy about the centre
  double noise2 = 0;
};

// The samples around a blob, out to a radius of `half` px, and their surroundings.
class BlobWindow {
 public:
  BlobWindow(const CfaSamples& samples, double half) : s_(samples), half_(half) {}

  // Sums of each filter phase about a centre, above the median of the surrounding samples of the
  // phase.
  std::array<PhaseSums, 4> sums_about(const Eigen::Vector2d& center) const {
    std::array<std::vector<double>, 4> around;
    each(center, [&](const Eigen::Vector2d& p, std::size_t at) {
      const double r = (p - center).norm();
      if (r > half_ - 2.0 && r < half_ + 3.0) {
        around[phase_at(p)].push_back(s_.signal_counts[at]);
      }
    });
    std::array<double, 4> level{};
    for (std::size_t k = 0; k < 4; ++k) {
      level[k] = around[k].empty() ? 0.0 : upper_median(around[k]);
    }
    std::array<PhaseSums, 4> sums{};
    each(center, [&](const Eigen::Vector2d& p, std::size_t at) {
      const double r = (p - center).norm();
      // Weights fall to zero over the last sample of the window, so that none enters or leaves as a
      // whole.
      const double taper = std::clamp(half_ + 0.5 - r, 0.0, 1.0);
      if (taper == 0.0) return;
      const std::size_t k = phase_at(p);
      const double w = taper * (s_.signal_counts[at] - level[k]);
      PhaseSums& sum = sums[k];
      sum.w += w;
      sum.wx += w * (p.x() - center.x());
      sum.wy += w * (p.y() - center.y());
      const double var = taper * taper * s_.variance_counts2[at];
      sum.vx += var * (p.x() - center.x()) * (p.x() - center.x());
      sum.vy += var * (p.y() - center.y()) * (p.y() - center.y());
      sum.noise2 += var;
    });
    return sums;
  }

  // Share of the samples within `radius` px (less than `half`) that are clipped.
  double saturated_share(const Eigen::Vector2d& center, double radius) const {
    std::size_t saturated = 0, in_blob = 0;
    each(center, [&](const Eigen::Vector2d& p, std::size_t at) {
      if (!((p - center).norm() < radius)) return;
      ++in_blob;
      saturated += s_.clipped[at];
    });
    return in_blob > 0 ? static_cast<double>(saturated) / static_cast<double>(in_blob) : 0.0;
  }

 private:
  static std::size_t phase_at(const Eigen::Vector2d& p) {
    return cfa_phase(static_cast<int>(p.x()), static_cast<int>(p.y()));
  }

  template <typename Visit>
  void each(const Eigen::Vector2d& center, const Visit& visit) const {
    const int reach = static_cast<int>(std::ceil(half_)) + 4;
    const int cx = static_cast<int>(std::lround(center.x())) - s_.x0;
    const int cy = static_cast<int>(std::lround(center.y())) - s_.y0;
    for (int y = std::max(0, cy - reach); y < std::min(s_.height, cy + reach + 1); ++y) {
      for (int x = std::max(0, cx - reach); x < std::min(s_.width, cx + reach + 1); ++x) {
        visit(Eigen::Vector2d(s_.x0 + x, s_.y0 + y),
              static_cast<std::size_t>(y) * static_cast<std::size_t>(s_.width) +
                  static_cast<std::size_t>(x));
      }
    }
  }

  const CfaSamples& s_;
  double half_;
};

// Sets image_px, std_px and saturated_share from the blob about `center`, width_px wide, or sets
// `problem` to the reason why there is no centroid.
void find_centroid(const CfaSamples& s, const HighlightOptions& options, Eigen::Vector2d center,
                   FoundHighlight& found) {
  // The surroundings: a window at least twice as large, as far as the sphere extends.
  const double half = found.width_px / 2.0 + 6.0;
  const BlobWindow window(s, half);
  double saturated_share = 0.0, std_px = 0.0;
  // The window is centred on the blob, so that what remains of the surroundings does not shift the
  // centroid.
  for (int round = 0; round < 4; ++round) {
    Eigen::Vector2d mean = Eigen::Vector2d::Zero();
    Eigen::Vector2d variance = Eigen::Vector2d::Zero();
    double phases = 0.0;
    for (const PhaseSums& sum : window.sums_about(center)) {
      if (!(sum.w > options.min_snr * std::sqrt(sum.noise2))) continue;
      phases += 1.0;
      mean += Eigen::Vector2d(sum.wx, sum.wy) / sum.w;
      variance += Eigen::Vector2d(sum.vx, sum.vy) / (sum.w * sum.w);
    }
    if (phases == 0.0) {
      found.problem = "the highlight is too weak";
      return;
    }
    mean /= phases;
    variance /= phases * phases;
    if (mean.norm() > half) {
      found.problem = "no compact highlight on the sphere";
      return;
    }
    saturated_share = window.saturated_share(center, 0.5 * found.width_px);
    center += mean;
    std_px = std::sqrt(0.5 * variance.sum() + options.model_std_px * options.model_std_px);
  }
  found.image_px = center;
  found.std_px = std_px;
  found.saturated_share = saturated_share;
}

}  // namespace

FoundHighlight find_highlight(const CfaSamples& samples, const SphereImage& sphere,
                              const HighlightOptions& options) {
  FoundHighlight found;
  found.image_px.setConstant(std::numeric_limits<double>::quiet_NaN());
  if (samples.width < 4 || samples.height < 4) {
    found.problem = "the sphere is out of view";
    return found;
  }
  const CellSums cells = cell_sums(samples);
  const Peak peak = brightest_cell(samples, cells, sphere);
  if (peak.n_cells < 16) {
    found.problem = "the sphere is too small in the frame, or out of it";
    return found;
  }
  if (!(peak.value - peak.base > options.min_snr * peak.scatter)) {
    found.problem = "no highlight on the sphere: is it hidden, or the LED off?";
    return found;
  }
  const Blob blob =
      grow(cells, peak.on_disc, peak.i, peak.j, peak.base + kFoot * (peak.value - peak.base));
  if (static_cast<double>(blob.cells) > options.max_share * static_cast<double>(peak.n_cells)) {
    found.problem = "the bright part of the sphere is not a compact highlight";
    return found;
  }
  if (blob.touches_rim) {
    found.problem = "the highlight lies at the rim of the sphere";
    return found;
  }
  found.width_px = std::max(blob.high_x - blob.low_x, blob.high_y - blob.low_y) + 1;
  find_centroid(samples, options,
                {samples.x0 + 0.5 * (blob.low_x + blob.high_x),
                 samples.y0 + 0.5 * (blob.low_y + blob.high_y)},
                found);
  return found;
}

}  // namespace scattermeter::calib
