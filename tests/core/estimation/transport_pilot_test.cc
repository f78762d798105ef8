#include "core/estimation/transport_pilot.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "core/material/dipole.h"
#include "tests/fixtures/core/derivative_check.h"
#include "tests/fixtures/core/plate_system.h"

namespace scattermeter {
namespace {

using test_support::plate;

constexpr double kPilotEta = 1.3;

TEST(TransportPilot, LightIsThatOfTheDipole) {
  const ScatteringImage image = dipole_pilot(plate().w, plate().knots, {1.2, 0.02, 1.0}, kPilotEta);
  const Eigen::VectorXd expected = plate().image({1.2, 0.02, kPilotEta});
  EXPECT_LT((image.l - expected).norm(), 1e-12 * expected.norm());
  EXPECT_EQ(image.variance.size(), 0);
}

TEST(TransportPilot, DerivativesAreThoseOfTheLight) {
  const ScatteringPoint at{1.2, 0.02, 1.0};
  const ScatteringImage image = dipole_pilot(plate().w, plate().knots, at, kPilotEta);
  Eigen::MatrixXd jacobian(image.l.size(), 2);
  jacobian << image.per_log_sigma_s, image.per_sigma_a;
  test_support::expect_derivatives(
      [&](const Eigen::VectorXd& x) {
        return dipole_pilot(plate().w, plate().knots, {std::exp(x[0]), x[1], 1.0}, kPilotEta).l;
      },
      Eigen::Vector2d(std::log(at.sigma_s_per_mm), at.sigma_a_per_mm), jacobian);
}

// Shares l / area of 2, 4 and none (negative light) of a sum of 12.
TEST(TransportPilot, PathVarianceFollowsLightOverArea) {
  const std::vector<double> area_mm2 = {1.0, 0.5, 2.0};
  const Eigen::VectorXd variance = smooth_path_variance(Eigen::Vector3d(2.0, 2.0, -0.1), area_mm2,
                                                        Eigen::Vector3d(1.0, 8.0, 3.0));
  EXPECT_NEAR(variance[0], 4.0, 1e-14);
  EXPECT_NEAR(variance[1], 8.0, 1e-14);
  EXPECT_EQ(variance[2], 0.0);
}

}  // namespace
}  // namespace scattermeter
