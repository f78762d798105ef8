#include "core/kernel_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

namespace scattermeter {
namespace {

constexpr int kMostTerms = 150;  // of a series; what is beyond is 1e-9 of a rest at 0.75
constexpr int kDirected = 40;    // up to this degree terms are told by direction

// largest_term of cosine 1, of any degree: the coefficient of tau^n in
// psi_c(rho - tau) rho^(n+2c+1) exp(y), exp(kappa tau) times sums of kappa^i (rho - tau)^-p.
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
    std::array<double, kMostTerms> binomial;
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

// Of the angle between the direction of a row and that of its pole: steps, told by their lower
// edge, where the cosine is largest.
constexpr double kAngle = 0.05;
constexpr std::size_t kAngles = 32;
std::size_t angle_cell(double angle) {
  return static_cast<std::size_t>(
      std::clamp(std::floor(angle / kAngle), 0.0, static_cast<double>(kAngles - 1)));
}

// Largest |C_m| of nu = c + 1/2 at angles from a cell's lower edge to pi / 2.
using Largest = std::array<std::array<std::array<double, kAngles>, kDirected + 1>, 3>;
const Largest& largest_gegenbauer() {
  static const Largest kLargest = [] {
    Largest largest{};
    constexpr int kSamples = 100;  // of a cell
    constexpr double kStep = kAngle / kSamples;
    for (std::size_t c = 0; c < 3; ++c) {
      const double nu = static_cast<double>(c) + 0.5;
      std::array<double, kDirected + 1> at, top;
      const auto values = [&](double x, std::array<double, kDirected + 1>& out) {
        out[0] = 1.0;
        out[1] = 2.0 * nu * x;
        for (int m = 2; m <= kDirected; ++m) {
          const auto k = static_cast<std::size_t>(m);
          out[k] = (2.0 * x * (m + nu - 1.0) * out[k - 1] - (m + 2.0 * nu - 2.0) * out[k - 2]) / m;
        }
      };
      values(1.0, top);
      for (std::size_t a = 0; a < kAngles; ++a) {
        for (int i = 0; i <= kSamples; ++i) {
          values(std::cos(kStep * (static_cast<double>(a) * kSamples + i)), at);
          for (std::size_t m = 0; m <= kDirected; ++m) {
            largest[c][m][a] = std::max(largest[c][m][a], std::abs(at[m]));
          }
        }
      }
      for (std::size_t m = 0; m <= kDirected; ++m) {
        for (std::size_t a = kAngles - 1; a-- > 0;) {
          largest[c][m][a] = std::max(largest[c][m][a], largest[c][m][a + 1]);
        }
        // Between samples: the second derivative by the angle is at most m^2 C_m(1), C_m being a
        // sum of cosines of up to m times the angle with factors that are not negative.
        const double between = static_cast<double>(m * m) * top[m] * kStep * kStep / 8.0;
        for (double& l : largest[c][m]) l = std::min(top[m], (l + between) * (1.0 + 1e-12));
      }
    }
    return largest;
  }();
  return kLargest;
}

// a_nm without its part that depends on y.
double gegenbauer_factor(int c, int n, int m) {
  const double nu = c + 0.5;
  return std::tgamma(nu) * (nu + m) * std::exp2(-m) /
         (std::tgamma(0.5 * (n - m) + 1.0) * std::tgamma(nu + 0.5 * (n + m) + 1.0));
}

// p_q(y) = psi_q rho^(2q+1) exp(y).
std::array<double, kDirected + 3> psi_polynomials(double y) {
  std::array<double, kDirected + 3> p;
  p[0] = 1.0;
  p[1] = 1.0 + y;
  for (std::size_t q = 1; q + 1 < p.size(); ++q) {
    p[q + 1] = static_cast<double>(2 * q + 1) * p[q] + y * y * p[q - 1];
  }
  return p;
}

// Of any medium, by depth and angle: the largest term of degree T + 1, and what those of higher
// degree add, relative.
struct Series {
  std::array<std::array<std::array<std::array<double, kAngles>, kDepths>, 3>, std::size(kDegrees)>
      first;
  std::array<std::array<std::array<std::array<float, KernelBounds::kTails>, kAngles>, kDepths>,
             std::size(kDegrees)>
      tail;
};

const Series& series() {
  static const std::unique_ptr<const Series> kSeries = [] {
    auto s = std::make_unique<Series>();
    const Largest& largest = largest_gegenbauer();
    for (int c = 0; c < 3; ++c) {
      const auto of_c = static_cast<std::size_t>(c);
      std::array<std::array<double, kDirected / 2 + 1>, kDirected + 1> factor{};
      for (int n = 0; n <= kDirected; ++n) {
        for (int j = 0; 2 * j <= n; ++j) {
          factor[static_cast<std::size_t>(n)][static_cast<std::size_t>(j)] =
              gegenbauer_factor(c, n, n - 2 * j);
        }
      }
      for (std::size_t depth = 0; depth < kDepths; ++depth) {
        const double y = depth_of(depth);
        const auto p = psi_polynomials(y);
        std::array<double, kMostTerms> line;
        for (int n = 0; n < kMostTerms; ++n) {
          line[static_cast<std::size_t>(n)] = along_the_line(c, n, y);
        }
        // Of degrees beyond kDirected, over u^kDirected.
        std::array<double, KernelBounds::kTails> beyond{};
        for (std::size_t u = 0; u < KernelBounds::kTails; ++u) {
          const double ratio = static_cast<double>(u + 1) / 32.0;
          for (std::size_t n = kMostTerms; n-- > kDirected + 1;) {
            beyond[u] = (beyond[u] + line[n]) * ratio;
          }
        }
        for (std::size_t a = 0; a < kAngles; ++a) {
          std::array<double, kDirected + 1> term;
          for (std::size_t n = 0; n <= kDirected; ++n) {
            double sum = 0.0, power = 1.0;
            for (std::size_t j = 0; 2 * j <= n; ++j, power *= 0.25 * y * y) {
              const std::size_t m = n - 2 * j;
              sum += factor[n][j] * p[of_c + m] * power * largest[of_c][m][a];
            }
            term[n] = std::min(sum, line[n]);
          }
          for (std::size_t i = 0; i < std::size(kDegrees); ++i) {
            const auto n = static_cast<std::size_t>(kDegrees[i] + 1);
            s->first[i][of_c][depth][a] = term[n];
            for (std::size_t u = 0; u < KernelBounds::kTails; ++u) {
              const double ratio = static_cast<double>(u + 1) / 32.0;
              double sum = beyond[u];
              for (std::size_t k = kDirected; k > n; --k) sum = (sum + term[k]) * ratio;
              float& tail = s->tail[i][depth][a][u];
              tail = std::max(tail, static_cast<float>((1.0 + sum / term[n]) * (1.0 + 1e-6)));
            }
          }
        }
      }
    }
    return s;
  }();
  return *kSeries;
}

void raise(ThreeBounds& bounds, const ThreeBounds& to) {
  for (std::size_t q = 0; q < 3; ++q) bounds[q] = std::max(bounds[q], to[q]);
}

}  // namespace

double largest_term(int c, int n, double y, double cosine) {
  const Largest& largest = largest_gegenbauer();
  const auto p = psi_polynomials(y);
  const std::size_t a = angle_cell(std::acos(cosine));
  double sum = 0.0, power = 1.0;
  for (int m = n; m >= 0; m -= 2, power *= 0.25 * y * y) {
    sum += gegenbauer_factor(c, n, m) * p[static_cast<std::size_t>(c + m)] * power *
           largest[static_cast<std::size_t>(c)][static_cast<std::size_t>(m)][a];
  }
  return sum;
}

KernelBounds::KernelBounds(std::span<const KernelDipole> media)
    : nearest_pole_mm_(std::numeric_limits<double>::infinity()) {
  for (const KernelDipole& m : media) nearest_pole_mm_ = std::min(nearest_pole_mm_, m.z_r_mm);
  per_z_r_ = 1.0 / nearest_pole_mm_;
  const Series& s = series();
  largest_.resize(media.size() * kCells);
  least_.resize(media.size() * kCells);
  rest_.resize(media.size() * std::size(kDegrees) * kReaches * kCells);
  tail_.resize(std::size(kDegrees) * kReaches * kCells * kTails, 1.0F);
  // Lower edge of a cell; cells are even within an octave. Told a little below: cells are found in
  // single precision.
  const auto edge = [&](std::size_t k) {
    if (k == 0) return 0.0;
    const auto i = static_cast<int>(k) - 1;
    return nearest_pole_mm_ * std::exp2(kFirstOctave + i / kPerOctave) *
           (1.0 + static_cast<double>(i % kPerOctave) / kPerOctave) * (1.0 - 1e-6);
  };
  constexpr double kRounding = 1.0 + 1e-6;
  const double near2 = nearest_pole_mm_ * nearest_pole_mm_;
  constexpr std::size_t kSeries = std::size(kDegrees);
  for (std::size_t k = 0; k < kCells; ++k) {
    for (std::size_t m = 0; m < media.size(); ++m) {
      std::array<double, 3> most{}, least{};
      // Directed, or in any direction.
      std::array<std::array<std::array<double, 3>, 2>, kSeries> rest{};
      for (const double z : {media[m].z_r_mm, media[m].z_v_mm}) {
        const double low = std::hypot(edge(k), z);
        const double y = media[m].kappa_per_mm * low;
        const double low2 = low * low;
        const double size[3] = {z / (low2 * low), z * z * z / (low2 * low2 * low), z / low};
        const double e = std::exp(-y);
        most[0] += size[0] * e * (1.0 + y);
        most[1] += size[0] * e * (1.0 + y) + size[1] * e * (3.0 + 3.0 * y + y * y);
        most[2] += size[2] * e;
        const double high =
            k + 1 < kCells ? edge(k + 1) * (1.0 + 2e-6) : std::numeric_limits<double>::infinity();
        // What falls by exp(-y) and grows by its terms' polynomials, at its largest in the cell.
        // Deeper than the tables exp(-y) times any of their polynomials only falls.
        const bool last = k + 1 == kCells;
        const std::size_t first_depth = std::min(
            depth_cell(last ? y : media[m].kappa_per_mm * std::hypot(high, z)), kDepths - 1);
        const std::size_t last_depth =
            last && media[m].kappa_per_mm > 0.0 ? kDepths - 1 : first_depth;
        // The nearest pole's distance is at most so much of this one's.
        const double nearer = last ? 1.0 : std::sqrt((high * high + near2) / (high * high + z * z));
        const double rho = last ? low : std::sqrt(high * high + near2);
        for (std::size_t i = 0; i < kSeries; ++i) {
          const double scale =
              std::pow(nearer, kDegrees[i] + 1) * std::pow(rho, kFalls[i] - kDegrees[i] - 1);
          for (const bool any : {false, true}) {
            const std::size_t angle = any ? 0 : angle_cell(std::atan2(z, high));
            std::array<double, 3> term{};
            for (std::size_t depth = first_depth; depth <= last_depth; ++depth) {
              const double shallow = depth == first_depth ? y : depth_of(depth - 1);
              const double dying = std::exp(-std::min(shallow, depth_of(kDepths - 1)));
              for (std::size_t c = 0; c < 3; ++c) {
                term[c] = std::max(term[c], dying * s.first[i][c][depth][angle]);
              }
            }
            rest[i][any][0] += scale * size[0] * term[1];
            rest[i][any][1] += scale * (size[0] * term[1] + size[1] * term[2]);
            rest[i][any][2] += scale * size[2] * term[0];
            float* const tail = &tail_[((i * kReaches + (any ? 2 : 0)) * kCells + k) * kTails];
            for (std::size_t u = 0; u < kTails; ++u) {
              tail[u] = std::max(tail[u], s.tail[i][first_depth][angle][u]);
            }
          }
        }
        if (k + 1 < kCells) {
          const double far = std::hypot(high, z), far2 = far * far;
          const double x = media[m].kappa_per_mm * far;
          const double f = z * std::exp(-x) / far;
          least[0] += f / far2 * (1.0 + x);
          least[1] += f / far2 * (1.0 + x + z * z / far2 * (3.0 + 3.0 * x + x * x));
          least[2] += f;
        }
      }
      for (std::size_t q = 0; q < 3; ++q) {
        largest_[m * kCells + k][q] = static_cast<float>(kRounding * most[q]);
        least_[m * kCells + k][q] = static_cast<float>(least[q] / kRounding);
        for (std::size_t i = 0; i < kSeries; ++i) {
          for (const bool any : {false, true}) {
            rest_[((m * kSeries + i) * kReaches + (any ? 2 : 0)) * kCells + k][q] =
                static_cast<float>(kRounding * rest[i][any][q]);
          }
        }
      }
    }
  }
  // Directed ones are to hold within their reach. Of those in any direction the tail only falls
  // with the distance: psi_c is completely monotone along a line, so |f^(n+1) / f^(n)| falls.
  for (std::size_t i = 0; i < kSeries; ++i) {
    for (std::size_t m = 0; m < media.size(); ++m) {
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
}

}  // namespace scattermeter
