#include "calib/pose/outline_look.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "calib/pose/coarse_turn.h"
#include "core/base/median.h"

namespace scattermeter::calib {
namespace {

constexpr int kOutlineReach = 12;  // cells to each side
constexpr int kBeside = 4;         // cells beside the reach
constexpr double kFar = 4.0;       // cells
constexpr double kLeastFound = 0.85;
constexpr double kNoises = 8.0;
constexpr double kLeastStep = 0.003;  // of the brightest cell
constexpr double kShade = 5.0;        // least steps, from which on light is judged by its ratio
constexpr std::size_t kCoarsePoints = 150;
constexpr int kCoarseStep = 2;  // cells
constexpr double kCoarseBeside = 2.0;

// Means over cells of a part of a frame, counts above black.
struct CellPicture {
  int x0 = 0, y0 = 0, width = 0, height = 0;  // cells
  int cell_px = 0;
  std::vector<float> counts;
  double noise_counts = 0;  // of a dark cell
  double brightest = 0;

  // Bilinear interpolation at a position in px; NaN outside.
  double at(const Eigen::Vector2d& px) const {
    const double u = (px.x() + 0.5) / cell_px - 0.5 - x0;
    const double v = (px.y() + 0.5) / cell_px - 0.5 - y0;
    const int i = static_cast<int>(std::floor(u));
    const int j = static_cast<int>(std::floor(v));
    if (i < 0 || j < 0 || i + 1 >= width || j + 1 >= height) return std::nan("");
    const double fu = u - i;
    const double fv = v - j;
    const float* p = &counts[static_cast<std::size_t>(j) * static_cast<std::size_t>(width) +
                             static_cast<std::size_t>(i)];
    const float* q = p + width;
    return (1 - fv) * ((1 - fu) * static_cast<double>(p[0]) + fu * static_cast<double>(p[1])) +
           fv * ((1 - fu) * static_cast<double>(q[0]) + fu * static_cast<double>(q[1]));
  }
};

CellPicture cells_around(const std::vector<ContourPoint>& contour, const capture::RawFrame& frame,
                         const SensorNoise& noise, int cell_px, double margin_px) {
  double x0 = 1e30, y0 = 1e30, x1 = -1e30, y1 = -1e30;
  for (const ContourPoint& p : contour) {
    x0 = std::min(x0, p.at_px.x());
    y0 = std::min(y0, p.at_px.y());
    x1 = std::max(x1, p.at_px.x());
    y1 = std::max(y1, p.at_px.y());
  }
  const auto low = [&](double v) {
    return static_cast<int>(std::max(0.0, std::floor((v - margin_px) / cell_px)));
  };
  const auto high = [&](double v, int size) {
    return static_cast<int>(std::min(std::ceil((v + margin_px) / cell_px),
                                     std::floor(static_cast<double>(size) / cell_px)));
  };
  CellPicture out;
  out.cell_px = cell_px;
  out.x0 = low(x0);
  out.y0 = low(y0);
  out.width = std::max(0, high(x1, frame.width_px) - out.x0);
  out.height = std::max(0, high(y1, frame.height_px) - out.y0);
  const double black = 0.25 * (frame.black_counts[0] + frame.black_counts[1] +
                               frame.black_counts[2] + frame.black_counts[3]);
  const double n = static_cast<double>(cell_px) * cell_px;
  std::vector<std::uint32_t> sums(static_cast<std::size_t>(out.width));
  for (int y = 0; y < out.height; ++y) {
    std::fill(sums.begin(), sums.end(), 0U);
    for (int j = 0; j < cell_px; ++j) {
      const std::uint16_t* row =
          &frame.samples[static_cast<std::size_t>((out.y0 + y) * cell_px + j) *
                             static_cast<std::size_t>(frame.width_px) +
                         static_cast<std::size_t>(out.x0 * cell_px)];
      for (std::uint32_t& sum : sums) {
        for (int i = 0; i < cell_px; ++i) sum += *row++;
      }
    }
    for (const std::uint32_t sum : sums) {
      out.counts.push_back(static_cast<float>(static_cast<double>(sum) / n - black));
      out.brightest = std::max(out.brightest, static_cast<double>(out.counts.back()));
    }
  }
  // A count of rounding and black besides the read noise.
  out.noise_counts = std::hypot(noise.read_noise_counts, 1.0) / cell_px;
  return out;
}

class OutlineFinder {
 public:
  OutlineFinder(const std::vector<ContourPoint>& contour, const CellPicture& cells)
      : contour_(contour),
        cells_(cells),
        least_(std::max(kNoises * cells.noise_counts, kLeastStep * cells.brightest)) {}

  OutlineLook look(const Eigen::Vector2d& shift_px) const {
    OutlineLook out;
    out.cell_px = cells_.cell_px;
    out.shift_px = shift_px;
    for (std::size_t i = 0; i < contour_.size(); ++i) {
      bool in_frame = false;
      const std::optional<double> cells = step_at(contour_[i], shift_px, in_frame);
      out.points += in_frame ? 1 : 0;
      if (!cells) continue;
      out.offsets.push_back({i, shift_px.dot(contour_[i].outward) + *cells * cells_.cell_px});
    }
    return out;
  }

  // Shift of the whole contour with the highest contrast.
  Eigen::Vector2d best_shift(double search_px) const {
    const int reach = static_cast<int>(search_px / cells_.cell_px);
    const std::size_t stride = std::max<std::size_t>(1, contour_.size() / kCoarsePoints);
    double best = -1;
    Eigen::Vector2d shift = Eigen::Vector2d::Zero();
    for (int dy = -reach; dy <= reach; dy += kCoarseStep) {
      for (int dx = -reach; dx <= reach; dx += kCoarseStep) {
        const Eigen::Vector2d at = cells_.cell_px * Eigen::Vector2d(dx, dy);
        double sum = 0;
        for (std::size_t i = 0; i < contour_.size(); i += stride) sum += contrast(contour_[i], at);
        if (sum <= best) continue;
        best = sum;
        shift = at;
      }
    }
    return shift;
  }

 private:
  double contrast(const ContourPoint& p, const Eigen::Vector2d& shift_px) const {
    const Eigen::Vector2d aside = kCoarseBeside * cells_.cell_px * p.outward;
    const double in = cells_.at(p.at_px + shift_px - aside);
    const double out = cells_.at(p.at_px + shift_px + aside);
    if (!std::isfinite(in) || !std::isfinite(out)) return 0;
    return (in - out) / (std::abs(in) + std::abs(out) + 2 * least_);
  }

  // Position of the first step from the outside along `outward`, cells from the shifted point.
  // in_frame: whether the search lies within the picture.
  std::optional<double> step_at(const ContourPoint& p, const Eigen::Vector2d& shift_px,
                                bool& in_frame) const {
    constexpr int kSamples = 4 * (kOutlineReach + kBeside) + 1;  // half a cell apart
    std::array<double, kSamples> profile;
    const auto cell_of = [](int k) { return kOutlineReach + kBeside - 0.5 * k; };
    for (int k = 0; k < kSamples; ++k) {
      const auto at = static_cast<std::size_t>(k);
      profile[at] = cells_.at(p.at_px + shift_px + cell_of(k) * cells_.cell_px * p.outward);
      if (!std::isfinite(profile[at])) return std::nullopt;
    }
    in_frame = true;
    const auto mean = [&](int first) {  // of four samples, 1.5 cells
      const auto f = static_cast<std::size_t>(first);
      return 0.25 * (profile[f] + profile[f + 1] + profile[f + 2] + profile[f + 3]);
    };
    // Between the samples 3 to 6 before and after k, 1.5 to 3 cells to each side. A face in the
    // shade may become bright within some cells: in proportion to its light, that is less than its
    // edge.
    const auto seen = [&](int first) { return std::asinh(mean(first) / (kShade * least_)); };
    const auto step = [&](int k) { return seen(k + 3) - seen(k - 6); };
    for (int k = 2 * kBeside; k <= kSamples - 1 - 2 * kBeside; ++k) {
      const double in = mean(k + 3), out = mean(k - 6);
      if (in - out < least_ || step(k) < step(k - 1) || step(k) < step(k + 1)) continue;
      const double level = 0.5 * (in + out);
      for (int i = k - 4; i < k + 4; ++i) {
        const double a = profile[static_cast<std::size_t>(i)];
        const double b = profile[static_cast<std::size_t>(i) + 1];
        if (a < level && b >= level) return cell_of(i) - 0.5 * (level - a) / (b - a);
      }
      return std::nullopt;
    }
    return std::nullopt;
  }

  const std::vector<ContourPoint>& contour_;
  const CellPicture& cells_;
  double least_;
};

bool is_near(const OutlineLook& look) {
  if (look.found_share() < kLeastFound) return false;
  std::vector<double> off;
  for (const OutlineOffset& o : look.offsets) off.push_back(std::abs(o.px));
  return upper_median(off) < kFar * look.cell_px;
}

}  // namespace

int outline_cell_px(int width_px) { return std::max(2, coarse_cell_px(width_px) / 2); }

OutlineLook look_at_outline(const std::vector<ContourPoint>& contour,
                            const capture::RawFrame& frame, const SensorNoise& noise,
                            double search) {
  const int cell_px = outline_cell_px(frame.width_px);
  OutlineLook near;
  near.cell_px = cell_px;
  if (contour.empty()) return near;
  const double margin_px = (kOutlineReach + kBeside + 2) * cell_px;
  {
    const CellPicture cells = cells_around(contour, frame, noise, cell_px, margin_px);
    near = OutlineFinder(contour, cells).look(Eigen::Vector2d::Zero());
    if (is_near(near)) return near;
  }
  const double search_px = search * frame.width_px;
  const CellPicture cells = cells_around(contour, frame, noise, cell_px, margin_px + search_px);
  const OutlineFinder finder(contour, cells);
  const OutlineLook far = finder.look(finder.best_shift(search_px));
  return far.offsets.size() > near.offsets.size() ? far : near;
}

}  // namespace scattermeter::calib
