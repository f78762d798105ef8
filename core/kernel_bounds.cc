#include "core/kernel_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace scattermeter {
namespace {

constexpr int kMostTerms = 140;  // terms of a rest; 0.75^140 140^4 is 1e-9

// Coefficient of tau^n in psi_c(rho - tau) rho^(n+2c+1) exp(y): exp(kappa tau) times sums of
// kappa^i (rho - tau)^-p.
double along_the_line(int c, int n, double y) {
  struct Power {
    int p, kappa;
    double factor;
  };
  static constexpr Power kPowers[3][3] = {{{1, 0, 1.0}, {1, 0, 0.0}, {1, 0, 0.0}},
                                          {{3, 0, 1.0}, {2, 1, 1.0}, {1, 0, 0.0}},
                                          {{5, 0, 3.0}, {4, 1, 3.0}, {3, 2, 1.0}}};
  double sum = 0.0;
  for (const Power& term : kPowers[c]) {
    if (term.factor == 0.0) continue;
    double exponential = 1.0;  // y^j / j!, j = n - i
    // (rho - tau)^-p has coefficients C(i + p - 1, i).
    std::array<double, kMostTerms + 12> binomial;
    binomial[0] = 1.0;
    for (int i = 1; i <= n; ++i) {
      binomial[static_cast<std::size_t>(i)] =
          binomial[static_cast<std::size_t>(i - 1)] * (i + term.p - 1) / i;
    }
    double part = 0.0;
    for (int j = 0; j <= n; ++j) {
      part += exponential * binomial[static_cast<std::size_t>(n - j)];
      exponential *= y / (j + 1);
    }
    sum += term.factor * std::pow(y, term.kappa) * part;
  }
  return sum;
}

// Of y: 0, then halves of octaves from 2^-6 on, each cell told by its upper edge.
constexpr std::size_t kDepths = 32;
double depth_of(std::size_t i) {
  return i == 0 ? std::exp2(-6.0) : std::exp2(0.5 * static_cast<double>(i) - 6.0);
}
std::size_t depth_cell(double y) {
  if (y <= depth_of(0)) return 0;
  return static_cast<std::size_t>(std::ceil(2.0 * (std::log2(y) + 6.0) - 1e-9));
}

// Of every medium: the largest derivative of degree T + 1, and what the higher ones add, relative.
struct Series {
  std::array<std::array<std::array<double, kDepths>, 3>, std::size(kDegrees)> first;
  std::array<std::array<std::array<float, KernelBounds::kTails>, kDepths>, std::size(kDegrees)>
      tail;
};

const Series& series() {
  static const Series kSeries = [] {
    Series s{};
    for (std::size_t y = 0; y < kDepths; ++y) {
      for (std::size_t c = 0; c < 3; ++c) {
        std::array<double, kMostTerms + 10> of;
        for (int n = 0; n < kMostTerms + 10; ++n) {
          of[static_cast<std::size_t>(n)] = along_the_line(static_cast<int>(c), n, depth_of(y));
        }
        for (std::size_t i = 0; i < std::size(kDegrees); ++i) {
          const auto n = static_cast<std::size_t>(kDegrees[i] + 1);
          s.first[i][c][y] = of[n];
          for (std::size_t u = 0; u < KernelBounds::kTails; ++u) {
            const double ratio = static_cast<double>(u + 1) / 32.0;
            double sum = 0.0, power = 1.0;
            for (std::size_t j = 0; j < kMostTerms; ++j, power *= ratio)
              sum += power * of[n + j] / of[n];
            s.tail[i][y][u] = std::max(s.tail[i][y][u], static_cast<float>(sum * (1.0 + 1e-6)));
          }
        }
      }
    }
    return s;
  }();
  return kSeries;
}

}  // namespace

double largest_derivative(int c, int n, double y) { return along_the_line(c, n, y); }

KernelBounds::KernelBounds(std::span<const KernelDipole> media)
    : nearest_pole_mm_(std::numeric_limits<double>::infinity()) {
  for (const KernelDipole& m : media) nearest_pole_mm_ = std::min(nearest_pole_mm_, m.z_r_mm);
  per_z_r_ = 1.0 / nearest_pole_mm_;
  const Series& s = series();
  largest_.resize(media.size() * kCells);
  least_.resize(media.size() * kCells);
  rest_.resize(media.size() * std::size(kDegrees) * kCells);
  tail_.resize(std::size(kDegrees) * kCells * kTails, 1.0F);
  // Lower edge of a cell; cells are even within an octave. Told a little below: cells are found in
  // single precision.
  const auto edge = [&](std::size_t k) {
    if (k == 0) return 0.0;
    const auto i = static_cast<int>(k) - 1;
    return nearest_pole_mm_ * std::exp2(kFirstOctave + i / kPerOctave) *
           (1.0 + static_cast<double>(i % kPerOctave) / kPerOctave) * (1.0 - 1e-6);
  };
  constexpr double kRounding = 1.0 + 1e-6;
  for (std::size_t k = 0; k < kCells; ++k) {
    std::size_t deepest = 0;
    for (std::size_t m = 0; m < media.size(); ++m) {
      std::array<double, 3> most{}, least{};
      std::array<std::array<double, 3>, std::size(kDegrees)> rest{};
      for (const double z : {media[m].z_r_mm, media[m].z_v_mm}) {
        const double low = std::hypot(edge(k), z);
        const double y = media[m].kappa_per_mm * low;
        const std::size_t depth = depth_cell(y);
        deepest = std::max(deepest, depth);
        const double e = std::exp(-y);
        const double low2 = low * low;
        const double scale[3] = {z / (low2 * low) * e, z * z * z / (low2 * low2 * low) * e,
                                 z / low * e};
        most[0] += scale[0] * (1.0 + y);
        most[1] += scale[0] * (1.0 + y) + scale[1] * (3.0 + 3.0 * y + y * y);
        most[2] += scale[2];
        for (std::size_t i = 0; i < std::size(kDegrees); ++i) {
          if (depth >= kDepths) {
            rest[i].fill(std::numeric_limits<double>::infinity());
            continue;
          }
          rest[i][0] += scale[0] * s.first[i][1][depth];
          rest[i][1] += scale[0] * s.first[i][1][depth] + scale[1] * s.first[i][2][depth];
          rest[i][2] += scale[2] * s.first[i][0][depth];
        }
        if (k + 1 < kCells) {
          const double high = std::hypot(edge(k + 1) * (1.0 + 2e-6), z), high2 = high * high;
          const double x = media[m].kappa_per_mm * high;
          const double f = z * std::exp(-x) / high;
          least[0] += f / high2 * (1.0 + x);
          least[1] += f / high2 * (1.0 + x + z * z / high2 * (3.0 + 3.0 * x + x * x));
          least[2] += f;
        }
      }
      for (std::size_t q = 0; q < 3; ++q) {
        largest_[m * kCells + k][q] = static_cast<float>(kRounding * most[q]);
        least_[m * kCells + k][q] = static_cast<float>(least[q] / kRounding);
        for (std::size_t i = 0; i < std::size(kDegrees); ++i) {
          rest_[(m * std::size(kDegrees) + i) * kCells + k][q] =
              static_cast<float>(kRounding * rest[i][q]);
        }
      }
    }
    if (deepest >= kDepths) continue;
    for (std::size_t i = 0; i < std::size(kDegrees); ++i) {
      std::copy(s.tail[i][deepest].begin(), s.tail[i][deepest].end(),
                tail_.begin() + static_cast<std::ptrdiff_t>((i * kCells + k) * kTails));
    }
  }
}

}  // namespace scattermeter
