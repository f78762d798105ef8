#include "core/sums/kernel_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/sums/series_bounds.h"

namespace scattermeter {
namespace {

constexpr double kRoundedUp = 1.0 + 1e-6;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

void raise(ThreeBounds& bounds, const ThreeBounds& to) {
  for (std::size_t q = 0; q < 3; ++q) bounds[q] = std::max(bounds[q], to[q]);
}

// Of the three quantities: psi_1 z, the same and psi_2 z^3, psi_0 z. Their factors psi rho^(2c+1)
// exp(y) are left out.
struct PoleSizes {
  double value, bend, decay;
  PoleSizes(double z, double rho)
      : value(z / (rho * rho * rho)),
        bend(z * z * z / (rho * rho * (rho * rho) * rho)),
        decay(z / rho) {}
};

}  // namespace

double KernelBounds::lower_edge_mm(std::size_t cell) const {
  if (cell == 0) return 0.0;
  const auto i = static_cast<int>(cell) - 1;
  return nearest_pole_mm_ * std::exp2(kFirstOctave + i / kPerOctave) *
         (1.0 + static_cast<double>(i % kPerOctave) / kPerOctave) * (1.0 - 1e-6);
}

double KernelBounds::upper_edge_mm(std::size_t cell) const {
  return cell + 1 < kCells ? lower_edge_mm(cell + 1) * (1.0 + 2e-6) : kInfinity;
}

KernelBounds::KernelBounds(std::span<const KernelDipole> media) : nearest_pole_mm_(kInfinity) {
  for (const KernelDipole& m : media) nearest_pole_mm_ = std::min(nearest_pole_mm_, m.z_r_mm);
  per_z_r_ = 1.0 / nearest_pole_mm_;
  largest_.resize(media.size() * kCells);
  least_.resize(media.size() * kCells);
  rest_.resize(media.size() * kSeries * kReaches * kCells);
  tail_.resize(kSeries * kReaches * kCells * kTails, 1.0F);
  for (std::size_t cell = 0; cell < kCells; ++cell) {
    for (std::size_t m = 0; m < media.size(); ++m) {
      bound_values(media[m], m, cell);
      bound_rests(media[m], m, cell);
    }
  }
  for (std::size_t i = 0; i < kSeries; ++i) {
    for (std::size_t m = 0; m < media.size(); ++m) cover_reaches_of_rests(m, i);
    cover_reaches_of_tails(i);
  }
}

void KernelBounds::bound_values(const KernelDipole& medium, std::size_t m, std::size_t cell) {
  const double high = upper_edge_mm(cell);
  std::array<double, 3> most{}, least{};
  for (const double z : {medium.z_r_mm, medium.z_v_mm}) {
    const double low = std::hypot(lower_edge_mm(cell), z);
    const double y = medium.kappa_per_mm * low;
    const PoleSizes size(z, low);
    const double e = std::exp(-y);
    most[0] += size.value * e * (1.0 + y);
    most[1] += size.value * e * (1.0 + y) + size.bend * e * (3.0 + 3.0 * y + y * y);
    most[2] += size.decay * e;
    if (high == kInfinity) continue;
    const double far = std::hypot(high, z), far2 = far * far;
    const double x = medium.kappa_per_mm * far;
    const double f = z * std::exp(-x) / far;
    least[0] += f / far2 * (1.0 + x);
    least[1] += f / far2 * (1.0 + x + z * z / far2 * (3.0 + 3.0 * x + x * x));
    least[2] += f;
  }
  for (std::size_t q = 0; q < 3; ++q) {
    largest_[m * kCells + cell][q] = static_cast<float>(kRoundedUp * most[q]);
    least_[m * kCells + cell][q] = static_cast<float>(least[q] / kRoundedUp);
  }
}

// Directed rests go to the reach 0, those for any direction to the last.
void KernelBounds::bound_rests(const KernelDipole& medium, std::size_t m, std::size_t cell) {
  constexpr std::size_t kDepths = SeriesBounds::kDepths;
  const SeriesBounds& series = series_bounds();
  const double near2 = nearest_pole_mm_ * nearest_pole_mm_;
  const double high = upper_edge_mm(cell);
  const bool last = high == kInfinity;
  std::array<std::array<std::array<double, 3>, 2>, kSeries> rest{};
  for (const double z : {medium.z_r_mm, medium.z_v_mm}) {
    const double low = std::hypot(lower_edge_mm(cell), z);
    const double y = medium.kappa_per_mm * low;
    const PoleSizes size(z, low);
    // What falls by exp(-y) and grows by its terms' polynomials, at its largest in the cell. Deeper
    // than the tables exp(-y) times any of their polynomials only falls.
    const std::size_t first_depth =
        std::min(SeriesBounds::depth_cell(last ? y : medium.kappa_per_mm * std::hypot(high, z)),
                 kDepths - 1);
    const std::size_t last_depth = last && medium.kappa_per_mm > 0.0 ? kDepths - 1 : first_depth;
    // The nearest pole's distance over this one's, at most.
    const double nearer = last ? 1.0 : std::sqrt((high * high + near2) / (high * high + z * z));
    const double rho = last ? low : std::sqrt(high * high + near2);
    for (std::size_t i = 0; i < kSeries; ++i) {
      const double scale =
          std::pow(nearer, kDegrees[i] + 1) * std::pow(rho, kFalls[i] - kDegrees[i] - 1);
      for (const bool any : {false, true}) {
        const std::size_t angle = any ? 0 : SeriesBounds::angle_cell(std::atan2(z, high));
        std::array<double, 3> term{};
        for (std::size_t depth = first_depth; depth <= last_depth; ++depth) {
          const double shallow = depth == first_depth ? y : SeriesBounds::largest_depth(depth - 1);
          const double dying =
              std::exp(-std::min(shallow, SeriesBounds::largest_depth(kDepths - 1)));
          for (std::size_t c = 0; c < 3; ++c) {
            term[c] = std::max(term[c], dying * series.first[i][c][depth][angle]);
          }
        }
        rest[i][any][0] += scale * size.value * term[1];
        rest[i][any][1] += scale * (size.value * term[1] + size.bend * term[2]);
        rest[i][any][2] += scale * size.decay * term[0];
        float* const tail = &tail_[((i * kReaches + (any ? 2 : 0)) * kCells + cell) * kTails];
        for (std::size_t u = 0; u < kTails; ++u) {
          tail[u] = std::max(tail[u], series.tail[i][first_depth][angle][u]);
        }
      }
    }
  }
  for (std::size_t i = 0; i < kSeries; ++i) {
    for (const bool any : {false, true}) {
      ThreeBounds& to = rest_[((m * kSeries + i) * kReaches + (any ? 2 : 0)) * kCells + cell];
      for (std::size_t q = 0; q < 3; ++q) to[q] = static_cast<float>(kRoundedUp * rest[i][any][q]);
    }
  }
}

// Directed bounds are to hold within their reach, those in any direction at any distance.
void KernelBounds::cover_reaches_of_rests(std::size_t m, std::size_t i) {
  const std::span all(&rest_[(m * kSeries + i) * kReaches * kCells], kReaches * kCells);
  const auto within = all.first(kCells), beyond = all.subspan(kCells, kCells);
  const auto any = all.last(kCells);
  for (std::size_t k = kCells - 1; k-- > 0;) raise(any[k], any[k + 1]);
  for (std::size_t step = 1; step < kPerOctave; step *= 2) {
    for (std::size_t k = 0; k + step < kCells; ++k) raise(within[k], within[k + step]);
  }
  for (std::size_t k = 0; k + 1 < kCells; ++k) raise(within[k], within[k + 1]);
  for (std::size_t k = 0; k < kCells; ++k) {
    beyond[k] = within[k];
    raise(beyond[k], within[std::min(k + kPerOctave, kCells - 1)]);
  }
}

// As for rests; but the tail in any direction only falls with the distance: psi_c is completely
// monotone along a line, so |f^(n+1) / f^(n)| falls.
void KernelBounds::cover_reaches_of_tails(std::size_t i) {
  const std::span all(&tail_[i * kReaches * kCells * kTails], kReaches * kCells * kTails);
  const auto within = all.first(kCells * kTails), beyond = all.subspan(kCells * kTails);
  for (std::size_t step = 1; step < kPerOctave; step *= 2) {
    for (std::size_t k = 0; k + step * kTails < within.size(); ++k) {
      within[k] = std::max(within[k], within[k + step * kTails]);
    }
  }
  for (std::size_t k = 0; k + kTails < within.size(); ++k) {
    within[k] = std::max(within[k], within[k + kTails]);
  }
  for (std::size_t k = 0; k < within.size(); ++k) {
    const std::size_t far = k + kPerOctave * kTails;
    beyond[k] = std::max(within[k],
                         within[far < within.size() ? far : within.size() - kTails + k % kTails]);
  }
}

}  // namespace scattermeter
