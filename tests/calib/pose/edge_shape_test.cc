#include "calib/pose/edge_shape.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace scattermeter::calib {
namespace {

// The definition by quadrature: t^k cut at 0, blurred, and averaged over the pixel's square.
double by_quadrature(int k, const Eigen::Vector2d& normal, double blur, double t) {
  constexpr int kSide = 24, kBlur = 400;
  double sum = 0;
  for (int i = 0; i < kSide; ++i) {
    for (int j = 0; j < kSide; ++j) {
      const Eigen::Vector2d p((i + 0.5) / kSide - 0.5, (j + 0.5) / kSide - 0.5);
      const double s = t - p.dot(normal);
      for (int b = 0; b < kBlur; ++b) {
        const double z = 12.0 * ((b + 0.5) / kBlur - 0.5);
        const double u = s + blur * z;
        if (u > 0) {
          sum += std::pow(u, k) * std::exp(-0.5 * z * z) / std::sqrt(2 * std::numbers::pi) * 12.0 /
                 kBlur;
        }
      }
    }
  }
  return sum / (kSide * kSide);
}

TEST(EdgeShape, IsTheBlurredMean) {
  for (const double angle : {0.3, 2.2}) {
    const Eigen::Vector2d normal(std::cos(angle), std::sin(angle));
    const EdgeShape shape(normal, 0.4);
    for (const double t : {-0.8, 0.1, 1.3}) {
      const auto s = shape.at(t).s;
      for (int k = 0; k < kEdgeTerms; ++k) {
        EXPECT_NEAR(s[static_cast<std::size_t>(k)], by_quadrature(k, normal, 0.4, t), 1e-3)
            << angle << " " << t << " " << k;
      }
    }
  }
}

// Far from the edge the blur and the square only add their variances: of t^2, blur^2 and
// (n_x^2 + n_y^2) / 12 = 1 / 12.
TEST(EdgeShape, HasItsLimits) {
  const EdgeShape shape(Eigen::Vector2d(0.6, 0.8), 0.5);
  const auto in = shape.at(6.0).s;
  EXPECT_NEAR(in[0], 1.0, 1e-12);
  EXPECT_NEAR(in[1], 6.0, 1e-11);
  EXPECT_NEAR(in[2], 36.0 + 0.25 + 1.0 / 12, 1e-10);
  for (const double s : shape.at(-6.0).s) EXPECT_EQ(s, 0.0);
}

TEST(EdgeShape, IsHalfAtTheEdgeAndMirrored) {
  for (const double angle : {0.0, 0.4, 1.5708}) {
    const EdgeShape shape(Eigen::Vector2d(std::cos(angle), std::sin(angle)), 0.3);
    EXPECT_NEAR(shape.at(0.0).s[0], 0.5, 1e-9);
    EXPECT_NEAR(shape.at(0.4).s[0] + shape.at(-0.4).s[0], 1.0, 1e-9);
    // S_1(t) - S_1(-t) = t.
    EXPECT_NEAR(shape.at(0.4).s[1] - shape.at(-0.4).s[1], 0.4, 1e-9);
  }
}

// S_1' = S_0 and S_2' = 2 S_1.
TEST(EdgeShape, TermsAreEachOthersIntegrals) {
  const EdgeShape shape(Eigen::Vector2d(0.6, -0.8), 0.7);
  constexpr double kStep = 1e-4;
  for (const double t : {-1.0, -0.2, 0.0, 0.5, 2.0}) {
    const auto up = shape.at(t + kStep).s, down = shape.at(t - kStep).s, here = shape.at(t).s;
    EXPECT_NEAR((up[1] - down[1]) / (2 * kStep), here[0], 1e-6) << t;
    EXPECT_NEAR((up[2] - down[2]) / (2 * kStep), 2 * here[1], 1e-6) << t;
  }
}

TEST(EdgeShape, DerivativesAreThoseOfTheTerms) {
  const Eigen::Vector2d normal(0.6, -0.8);
  constexpr double kBlur = 0.7, kStep = 1e-4;
  const EdgeShape shape(normal, kBlur), wider(normal, kBlur + kStep),
      narrower(normal, kBlur - kStep);
  for (const double t : {-1.0, -0.2, 0.0, 0.5, 2.0}) {
    const EdgeShape::Terms terms = shape.at(t);
    for (std::size_t k = 0; k < kEdgeTerms; ++k) {
      EXPECT_NEAR(terms.per_t[k],
                  (shape.at(t + kStep).s[k] - shape.at(t - kStep).s[k]) / (2 * kStep), 1e-6)
          << t;
      EXPECT_NEAR(terms.per_blur[k], (wider.at(t).s[k] - narrower.at(t).s[k]) / (2 * kStep), 1e-6)
          << t;
    }
  }
}

}  // namespace
}  // namespace scattermeter::calib
