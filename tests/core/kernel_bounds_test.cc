#include "core/kernel_bounds.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace scattermeter {
namespace {

// n-th Taylor coefficient along a line that meets the direction to the pole at cos, times
// rho^(n + 2c + 1) exp(y): psi_(c+q) (x tau - tau^2/2)^q / q!, the psi by their recurrence.
double derivative_along(int c, int n, double y, double cosine) {
  std::vector<double> psi = {1.0, 1.0 + y};
  for (int q = 1; q <= c + n; ++q) {
    psi.push_back((2.0 * q + 1.0) * psi[static_cast<std::size_t>(q)] +
                  y * y * psi[static_cast<std::size_t>(q - 1)]);
  }
  double sum = 0.0;
  for (int q = (n + 1) / 2; q <= n; ++q) {
    // (x tau)^(q - m) (-tau^2 / 2)^m / (m! (q - m)!) with q + m = n.
    const int m = n - q;
    sum += psi[static_cast<std::size_t>(c + q)] * std::pow(cosine, q - m) * std::pow(-0.5, m) /
           (std::tgamma(m + 1.0) * std::tgamma(q - m + 1.0));
  }
  return sum;
}

TEST(KernelBounds, NoDirectionHasALargerDerivative) {
  for (int c = 0; c <= 2; ++c) {
    for (int n = 0; n <= 12; ++n) {
      for (const double y : {0.0, 0.03, 0.3, 1.0, 3.0, 10.0, 30.0}) {
        const double bound = largest_derivative(c, n, y);
        EXPECT_NEAR(derivative_along(c, n, y, 1.0), bound, 1e-9 * bound);
        for (int i = 0; i <= 400; ++i) {
          EXPECT_LE(std::abs(derivative_along(c, n, y, i / 400.0)), bound * (1.0 + 1e-9))
              << "c " << c << " n " << n << " y " << y << " cos " << i / 400.0;
        }
      }
    }
  }
}

// For kappa = 0: Gegenbauer polynomials at 1, C(n + 2 lambda - 1, n), times (2c - 1)!!.
TEST(KernelBounds, GegenbauerWithoutAbsorption) {
  EXPECT_DOUBLE_EQ(largest_derivative(0, 9, 0.0), 1.0);
  EXPECT_DOUBLE_EQ(largest_derivative(1, 9, 0.0), 55.0);
  EXPECT_DOUBLE_EQ(largest_derivative(2, 9, 0.0), 3.0 * 715.0);
}

// Largest and least hold within every cell, and meet at its edges.
TEST(KernelBounds, CellsHoldTheirDistances) {
  const std::vector<KernelDipole> media = {{0.4, 1.5, 0.2}, {2.0, 7.0, 0.05}};
  const KernelBounds bounds(media);
  EXPECT_EQ(bounds.nearest_pole_mm(), 0.4);
  std::size_t last = 0;
  for (double d = 0.0; d < 1e4; d = 1.01 * d + 1e-3) {
    const std::size_t cell = bounds.cell(d);
    EXPECT_GE(cell, last);
    last = cell;
    for (std::size_t m = 0; m < media.size(); ++m) {
      double truth[3] = {0, 0, 0};
      for (const double z : {media[m].z_r_mm, media[m].z_v_mm}) {
        const double rho2 = d * d + z * z, rho = std::sqrt(rho2), y = media[m].kappa_per_mm * rho;
        const double e = z * std::exp(-y) / rho;
        truth[0] += e * (1 + y) / rho2;
        truth[1] += e / rho2 * (1 + y + z * z / rho2 * (3 + 3 * y + y * y));
        truth[2] += e;
      }
      for (std::size_t q = 0; q < 3; ++q) {
        if (truth[q] < 1e-30) continue;
        EXPECT_LE(truth[q], double(bounds.largest(m, cell)[q])) << d;
        EXPECT_GE(truth[q], double(bounds.least(m, cell)[q])) << d;
        // A sixteenth of an octave and, with exp(-y), what a cell is wide.
        const double wide = std::pow(1.07, 5.0) * std::exp(0.07 * media[m].kappa_per_mm * (d + 3));
        if (d > 0.01) {
          EXPECT_LE(double(bounds.largest(m, cell)[q]), wide * truth[q]) << d;
        }
      }
    }
  }
}

// The rest of a series of one point, summed on, is below what the tables say, of every degree.
TEST(KernelBounds, RestsAreBelowTheirBound) {
  const std::vector<KernelDipole> media = {{0.4, 1.5, 0.3}};
  const KernelBounds bounds(media);
  for (std::size_t i = 0; i < std::size(kDegrees); ++i) {
    for (const double d : {0.0, 0.5, 1.0, 3.0, 10.0, 40.0}) {
      const double rho0 = std::hypot(d, 0.4);
      for (const double u : {0.05, 0.2, 0.5, 0.7}) {
        const double a = u * rho0;
        double rest[3] = {0, 0, 0};
        for (const double z : {0.4, 1.5}) {
          const double rho = std::hypot(d, z), y = 0.3 * rho, e = std::exp(-y);
          for (int n = kDegrees[i] + 1; n < 120; ++n) {
            const double power = std::pow(a / rho, n);
            const double one = z / std::pow(rho, 3) * e * power * largest_derivative(1, n, y);
            rest[0] += one;
            rest[1] +=
                one + std::pow(z, 3) / std::pow(rho, 5) * e * power * largest_derivative(2, n, y);
            rest[2] += z / rho * e * power * largest_derivative(0, n, y);
          }
        }
        const std::size_t cell = bounds.cell(d);
        const double own = std::pow(u, kDegrees[i] + 1) *
                           double(bounds.tail(i, cell, static_cast<std::size_t>(32.0 * u)));
        for (std::size_t q = 0; q < 3; ++q) {
          EXPECT_LE(rest[q], own * double(bounds.rest(0, i, cell)[q]))
              << "degree " << kDegrees[i] << " d " << d << " u " << u << " quantity " << q;
        }
      }
    }
  }
}

}  // namespace
}  // namespace scattermeter
