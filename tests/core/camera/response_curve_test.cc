#include "core/camera/response_curve.h"

#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

namespace scattermeter {
namespace {

TEST(ResponseCurve, WithoutKnotsChangesNothing) {
  const ResponseCurve curve;
  EXPECT_TRUE(curve.is_identity());
  EXPECT_EQ(curve.light_counts(1234.5), 1234.5);
  EXPECT_EQ(curve.gain_at(1234.5), 1.0);
}

TEST(ResponseCurve, PassesThroughItsKnotsAndZero) {
  const std::vector<double> knots = {1000, 2000, 4000}, values = {0.002, 0.005, 0.013};
  const ResponseCurve curve(knots, values);
  EXPECT_EQ(curve.log_ratio_at(0), 0.0);
  EXPECT_EQ(curve.log_ratio_at(-5), 0.0);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(curve.log_ratio_at(knots[i]), values[i], 1e-15);
    EXPECT_NEAR(curve.light_counts(knots[i]), knots[i] * std::exp(values[i]), 1e-9);
  }
}

// The linear form of the fit is the curve.
TEST(ResponseCurve, WeightsOfTheKnotsGiveTheCurve) {
  const std::vector<double> knots = {900, 2100, 3900};
  const Eigen::Vector3d values(0.003, -0.004, 0.01);
  const ResponseCurve curve(knots, {values[0], values[1], values[2]});
  for (const double y : {10.0, 500.0, 1700.0, 3900.0, 4095.0}) {
    EXPECT_NEAR(ResponseCurve::weights(knots, y) * values, curve.log_ratio_at(y), 1e-14);
  }
}

TEST(ResponseCurve, DerivativesAgreeWithDifferences) {
  const ResponseCurve curve({1500, 4000}, {0.004, 0.012});
  for (const double y : {200.0, 1500.0, 3800.0}) {
    const double h = 1e-2;
    EXPECT_NEAR(curve.slope_at(y),
                (curve.log_ratio_at(y + h) - curve.log_ratio_at(y - h)) / (2 * h), 1e-12);
    EXPECT_NEAR(curve.gain_at(y), (curve.light_counts(y + h) - curve.light_counts(y - h)) / (2 * h),
                1e-8);
  }
}

TEST(ResponseCurve, RefusesKnotsThatDoNotAscend) {
  EXPECT_THROW(ResponseCurve({2000, 1000}, {0, 0}), std::invalid_argument);
  EXPECT_THROW(ResponseCurve({0, 1000}, {0, 0}), std::invalid_argument);
  EXPECT_THROW(ResponseCurve({1000}, {0, 0}), std::invalid_argument);
  EXPECT_THROW(ResponseCurve({1, 2, 3, 4, 5}, {0, 0, 0, 0, 0}), std::invalid_argument);
  EXPECT_THROW(ResponseCurve({1000}, {std::nan("")}), std::invalid_argument);
}

}  // namespace
}  // namespace scattermeter
