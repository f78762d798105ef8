#include "core/sums/series_bounds.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace scattermeter {
namespace {

constexpr int kMostTerms = 150;  // of a series; what is beyond is 1e-9 of a rest at 0.75
constexpr int kDirected = 40;    // terms up to this degree are bounded by direction
constexpr double kAngleStep_rad = 0.05;
constexpr std::size_t kAngleCells = SeriesBounds::kAngles, kRatios = SeriesBounds::kRatios;

using Terms = std::array<double, kDirected + 1>;  // by degree

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

// C_m(x) of order nu, by degree m.
Terms gegenbauer(double nu, double x) {
  Terms c;
  c[0] = 1.0;
  c[1] = 2.0 * nu * x;
  for (int m = 2; m <= kDirected; ++m) {
    const auto k = static_cast<std::size_t>(m);
    c[k] = (2.0 * x * (m + nu - 1.0) * c[k - 1] - (m + 2.0 * nu - 2.0) * c[k - 2]) / m;
  }
  return c;
}

// The largest |C_m| of nu = c + 1/2 at angles from a cell's lower edge to pi / 2: [c][m][angle].
using LargestGegenbauer = std::array<std::array<std::array<double, kAngleCells>, kDirected + 1>, 3>;
const LargestGegenbauer& largest_gegenbauer() {
  static const LargestGegenbauer kLargest = [] {
    LargestGegenbauer largest{};
    constexpr int kSamples = 100;  // of a cell
    constexpr double kStep = kAngleStep_rad / kSamples;
    for (std::size_t c = 0; c < 3; ++c) {
      const double nu = static_cast<double>(c) + 0.5;
      const Terms top = gegenbauer(nu, 1.0);
      for (std::size_t a = 0; a < kAngleCells; ++a) {
        for (int i = 0; i <= kSamples; ++i) {
          const Terms at =
              gegenbauer(nu, std::cos(kStep * (static_cast<double>(a) * kSamples + i)));
          for (std::size_t m = 0; m <= kDirected; ++m) {
            largest[c][m][a] = std::max(largest[c][m][a], std::abs(at[m]));
          }
        }
      }
      for (std::size_t m = 0; m <= kDirected; ++m) {
        for (std::size_t a = kAngleCells - 1; a-- > 0;) {
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

// gegenbauer_factor(c, n, n - 2j): [n][j].
using Factors = std::array<std::array<double, kDirected / 2 + 1>, kDirected + 1>;
Factors gegenbauer_factors(int c) {
  Factors factors{};
  for (int n = 0; n <= kDirected; ++n) {
    for (int j = 0; 2 * j <= n; ++j) {
      factors[static_cast<std::size_t>(n)][static_cast<std::size_t>(j)] =
          gegenbauer_factor(c, n, n - 2 * j);
    }
  }
  return factors;
}

// Terms of degrees beyond kDirected over u^kDirected, by ratio.
std::array<double, kRatios> terms_beyond(const std::array<double, kMostTerms>& line) {
  std::array<double, kRatios> beyond{};
  for (std::size_t u = 0; u < kRatios; ++u) {
    const double ratio = static_cast<double>(u + 1) / 32.0;
    for (std::size_t n = kMostTerms; n-- > kDirected + 1;) {
      beyond[u] = (beyond[u] + line[n]) * ratio;
    }
  }
  return beyond;
}

// Enters a depth and angle into the tables, for one c.
void add_to_tables(const Terms& term, const std::array<double, kRatios>& beyond, std::size_t c,
                   std::size_t depth, std::size_t angle, SeriesBounds& tables) {
  for (std::size_t i = 0; i < std::size(kDegrees); ++i) {
    const auto n = static_cast<std::size_t>(kDegrees[i] + 1);
    tables.first[i][c][depth][angle] = term[n];
    for (std::size_t u = 0; u < kRatios; ++u) {
      const double ratio = static_cast<double>(u + 1) / 32.0;
      double sum = beyond[u];
      for (std::size_t k = kDirected; k > n; --k) sum = (sum + term[k]) * ratio;
      float& tail = tables.tail[i][depth][angle][u];
      tail = std::max(tail, static_cast<float>((1.0 + sum / term[n]) * (1.0 + 1e-6)));
    }
  }
}

}  // namespace

double largest_term(int c, int n, double y, double cosine) {
  const LargestGegenbauer& largest = largest_gegenbauer();
  const auto p = psi_polynomials(y);
  const std::size_t a = SeriesBounds::angle_cell(std::acos(cosine));
  double sum = 0.0, power = 1.0;
  for (int m = n; m >= 0; m -= 2, power *= 0.25 * y * y) {
    sum += gegenbauer_factor(c, n, m) * p[static_cast<std::size_t>(c + m)] * power *
           largest[static_cast<std::size_t>(c)][static_cast<std::size_t>(m)][a];
  }
  return sum;
}

double SeriesBounds::largest_depth(std::size_t depth_cell) {
  return depth_cell == 0 ? std::exp2(-6.0) : std::exp2(0.5 * static_cast<double>(depth_cell) - 6.0);
}

std::size_t SeriesBounds::depth_cell(double y) {
  if (y <= largest_depth(0)) return 0;
  return static_cast<std::size_t>(std::ceil(2.0 * (std::log2(y) + 6.0) - 1e-9));
}

std::size_t SeriesBounds::angle_cell(double angle_rad) {
  return static_cast<std::size_t>(std::clamp(std::floor(angle_rad / kAngleStep_rad), 0.0,
                                             static_cast<double>(kAngleCells - 1)));
}

const SeriesBounds& series_bounds() {
  static const std::unique_ptr<const SeriesBounds> kTables = [] {
    auto tables = std::make_unique<SeriesBounds>();
    const LargestGegenbauer& largest = largest_gegenbauer();
    for (int c = 0; c < 3; ++c) {
      const auto of_c = static_cast<std::size_t>(c);
      const Factors factors = gegenbauer_factors(c);
      for (std::size_t depth = 0; depth < SeriesBounds::kDepths; ++depth) {
        const double y = SeriesBounds::largest_depth(depth);
        const auto p = psi_polynomials(y);
        std::array<double, kMostTerms> line;
        for (int n = 0; n < kMostTerms; ++n) {
          line[static_cast<std::size_t>(n)] = along_the_line(c, n, y);
        }
        const std::array<double, kRatios> beyond = terms_beyond(line);
        for (std::size_t a = 0; a < kAngleCells; ++a) {
          Terms term;
          for (std::size_t n = 0; n <= kDirected; ++n) {
            double sum = 0.0, power = 1.0;
            for (std::size_t j = 0; 2 * j <= n; ++j, power *= 0.25 * y * y) {
              const std::size_t m = n - 2 * j;
              sum += factors[n][j] * p[of_c + m] * power * largest[of_c][m][a];
            }
            term[n] = std::min(sum, line[n]);
          }
          add_to_tables(term, beyond, of_c, depth, a, *tables);
        }
      }
    }
    return tables;
  }();
  return *kTables;
}

}  // namespace scattermeter
