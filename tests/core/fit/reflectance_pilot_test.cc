#include "core/fit/reflectance_pilot.h"

#include <cmath>

#include <gtest/gtest.h>

namespace scattermeter {
namespace {

// Its own family, from far apart depths, is found; each knot seen by itself, to 1 %.
TEST(ReflectancePilot, FindsItsOwnFamily) {
  const DistanceKnots knots(0.1, 40.0);
  for (double depth : {0.2, 0.8, 3.2}) {
    const Eigen::ArrayXd t = log_squared_depth(knots, depth).array();
    const Eigen::VectorXd log_r = 2.0 - 1.3 * t - 0.2 * (0.5 * t).exp();
    const MarginalInformation image{
        Eigen::MatrixXd((100.0 * (-log_r.array()).exp()).matrix().asDiagonal()),
        Eigen::VectorXd::Constant(knots.size(), 100.0),
        {}};
    const auto pilot = reflectance_pilot(image, image, knots);
    ASSERT_TRUE(pilot.has_value());
    EXPECT_NEAR(pilot->source_depth_mm / depth, 1.0, 0.2);
    EXPECT_LT((pilot->log_r - log_r).cwiseAbs().maxCoeff(), 0.3);
  }
}

TEST(ReflectancePilot, OfNothingIsNone) {
  const DistanceKnots knots(0.1, 40.0);
  MarginalInformation image{Eigen::MatrixXd::Zero(3, knots.size()), Eigen::VectorXd::Ones(3), {}};
  EXPECT_FALSE(reflectance_pilot(image, image, knots).has_value());
  image.kernel.setOnes();
  image.data.setConstant(-1.0);
  EXPECT_FALSE(reflectance_pilot(image, image, knots).has_value());
}

}  // namespace
}  // namespace scattermeter
