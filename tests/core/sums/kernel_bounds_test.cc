#include "core/sums/kernel_bounds.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "tests/fixtures/core/pole_terms.h"

namespace scattermeter {
namespace {

using test_support::derivative_along;
using L = long double;

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

// psi_c at a distance rho, in long double.
long double psi(int c, long double kappa, long double rho) {
  const long double y = kappa * rho, e = std::exp(-y) / rho, rho2 = rho * rho;
  if (c == 0) return e;
  if (c == 1) return e * (1 + y) / rho2;
  return e * (3 + 3 * y + y * y) / (rho2 * rho2);
}

// What the series of a single point leaves out, in every direction and at every distance that a
// reach covers, is below what the tables say, of every degree: against the function itself.
TEST(KernelBounds, RestsAreBelowTheirBound) {
  constexpr double kKappa = 0.3, kPoles[] = {0.4, 1.5};
  const std::vector<KernelDipole> media = {{kPoles[0], kPoles[1], kKappa}};
  const KernelBounds bounds(media);
  int sharp = 0;
  for (const double near : {0.0, 0.2, 0.5, 1.0, 3.0, 10.0, 40.0}) {
    const std::size_t cell = bounds.cell(near);
    for (const double times : {1.0, 1.5, 1.9, 2.5, 3.9, 10.0}) {
      const double d = near * times;
      const std::size_t reach = KernelBounds::reach(cell, bounds.cell(d));
      for (const double u : {0.05, 0.2, 0.5, 0.7}) {
        const double a = u * std::hypot(near, kPoles[0]);
        for (int direction = 0; direction < 12; ++direction) {
          const double along = std::cos(0.27 * direction);
          L rest[std::size(kDegrees)][3] = {};
          for (const double z : kPoles) {
            const L rho = std::sqrt(L(d) * d + L(z) * z), cosine = L(d) * along / rho, t = a / rho;
            const L w = std::sqrt(rho * rho + L(a) * a - 2 * rho * a * cosine);
            L missing[3];
            for (int c = 0; c < 3; ++c) missing[c] = psi(c, kKappa, w);
            int n = 0;
            for (std::size_t i = 0; i < std::size(kDegrees); ++i) {
              for (; n <= kDegrees[i]; ++n) {
                for (int c = 0; c < 3; ++c) {
                  missing[c] -= derivative_along(c, n, double(kKappa * rho), double(cosine)) *
                                std::pow(t, n) * std::exp(-kKappa * rho) / std::pow(rho, 2 * c + 1);
                }
              }
              rest[i][0] += z * missing[1];
              rest[i][1] += std::abs(z * missing[1]) + std::abs(z * z * z * missing[2]);
              rest[i][2] += z * missing[0];
            }
          }
          for (std::size_t i = 0; i < std::size(kDegrees); ++i) {
            const double rho = std::hypot(d, kPoles[0]);
            const double own =
                std::pow(a, kDegrees[i] + 1) / std::pow(rho, kFalls[i]) *
                double(bounds.tail(i, reach, cell, static_cast<std::size_t>(32.0 * u)));
            for (std::size_t q = 0; q < 3; ++q) {
              const double bound = own * double(bounds.rest(0, i, reach, cell)[q]);
              // Terms are known to 1e-15 of the whole.
              EXPECT_LE(double(std::abs(rest[i][q])), bound + 1e-13)
                  << "degree " << kDegrees[i] << " d " << d << " u " << u << " quantity " << q;
              if (double(std::abs(rest[i][q])) > 0.3 * bound) ++sharp;
            }
          }
        }
      }
    }
  }
  EXPECT_GT(sharp, 100);
}

}  // namespace
}  // namespace scattermeter
