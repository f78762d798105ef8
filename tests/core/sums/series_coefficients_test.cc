#include "core/sums/series_coefficients.h"

#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace scattermeter {
namespace {

// Against their definition, summed in long double.
TEST(SeriesCoefficients, AreThoseOfTheirDefinition) {
  using L = long double;
  constexpr std::size_t kPoints = 20;
  constexpr double kRadius = 2.0, kCenter[3] = {5.0, -1.0, 0.5};
  constexpr float kFrame[9] = {0, 1, 0, 0, 0, 1, 1, 0, 0};  // axes y, z; normal x
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (const bool planar : {true, false}) {
    std::vector<double> x, y, z;
    std::vector<float> weight;
    double weights = 0.0;
    for (std::size_t i = 0; i < kPoints; ++i) {
      x.push_back(kCenter[0] + (planar ? 0.0 : uniform(random)));
      y.push_back(kCenter[1] + uniform(random));
      z.push_back(kCenter[2] + uniform(random));
      weight.push_back(static_cast<float>(1.5 + uniform(random)));
      weights += double(weight.back());
    }
    for (const int degree : kDegrees) {
      KernelMoments moments;
      sum_moments(x.data(), y.data(), z.data(), weight.data(), kPoints, kCenter, kRadius, kFrame,
                  planar, degree, moments);
      std::vector<float> got(coefficient_index(degree + 1, 0, planar), NAN);
      series_coefficients(moments, planar, degree, weights, got.data());
      for (int n = 0; n <= degree; ++n) {
        for (int m = 0; 2 * m <= n; ++m) {
          const int k = n - 2 * m;
          std::size_t at = coefficient_index(n, m, planar);
          for (int l = 0; l <= (planar ? 0 : k); ++l) {
            for (int j = 0; j <= k - l; ++j, ++at) {
              const L factor =
                  std::pow(L(-0.5), m) / (std::tgamma(L(m + 1)) * std::tgamma(L(k - l - j + 1)) *
                                          std::tgamma(L(j + 1)) * std::tgamma(L(l + 1)));
              L sum = 0.0L;
              for (std::size_t i = 0; i < kPoints; ++i) {
                const L a = (L(y[i]) - L(kCenter[1])) / kRadius;
                const L b = (L(z[i]) - L(kCenter[2])) / kRadius;
                const L c = (L(x[i]) - L(kCenter[0])) / kRadius;
                sum += L(weight[i]) * std::pow(a * a + b * b + c * c, m) * std::pow(a, k - l - j) *
                       std::pow(b, j) * std::pow(c, l);
              }
              const L truth = factor * sum / L(weights);
              EXPECT_NEAR(double(L(got[at]) - truth), 0.0, 1e-6 * double(std::abs(factor)))
                  << planar << ' ' << degree << ' ' << n << ' ' << m << ' ' << l << ' ' << j;
            }
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace scattermeter
