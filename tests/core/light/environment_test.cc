#include "core/light/environment.h"

#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

#include "tests/fixtures/core/probes.h"

namespace scattermeter {
namespace {

TEST(Environment, ForwardAndUpTurnTheProbe) {
  const Eigen::Quaterniond r = world_from_probe({2, 0, 0}, {0, 0, 5});
  EXPECT_LT((r * Eigen::Vector3d(0, 1, 0) - Eigen::Vector3d(1, 0, 0)).norm(), 1e-12);
  EXPECT_LT((r * Eigen::Vector3d(1, 0, 0) - Eigen::Vector3d(0, -1, 0)).norm(), 1e-12);
  EXPECT_LT((r * Eigen::Vector3d(0, 0, 1) - Eigen::Vector3d(0, 0, 1)).norm(), 1e-12);
  // The default is the identity.
  EXPECT_LT(world_from_probe({0, 1, 0}, {0, 0, 1}).angularDistance(Eigen::Quaterniond::Identity()),
            1e-12);
  EXPECT_THROW(world_from_probe({0, 0, 1}, {0, 0, 2}), std::invalid_argument);
  EXPECT_THROW(world_from_probe({0, 0, 0}, {0, 0, 2}), std::invalid_argument);
}

TEST(Environment, RadianceTowardIsThatOfThePixel) {
  Environment probe = test_support::even_probe(ProbeProjection::kEquirectangular, 8, 4, {1, 2, 3});
  probe.radiance[3 * (1 * 8 + 6) + 1] = 7.0F;  // row 1 (above the horizon), right of the centre
  const Eigen::Vector3d d = ProbeMap(ProbeProjection::kEquirectangular, 8, 4).direction(6.5, 1.5);
  EXPECT_EQ(probe.radiance_toward(d)[1], 7.0F);
  EXPECT_EQ(probe.radiance_toward(-d)[1], 2.0F);
  probe.world_from_probe = world_from_probe({0, 0, 1}, {0, -1, 0});
  EXPECT_EQ(probe.radiance_toward(probe.world_from_probe * d)[1], 7.0F);
}

TEST(Environment, ProblemNamesPixelChannelAndValue) {
  std::vector<float> radiance(3 * 6 * 4, 1.0F);
  EXPECT_EQ(probe_problem(6, 4, radiance), "");
  radiance[3 * (2 * 6 + 5) + 1] = -0.5F;
  EXPECT_EQ(probe_problem(6, 4, radiance),
            "pixel (5, 2), channel G: radiance is -0.5, must be finite and not negative");
  radiance[3 * (2 * 6 + 5) + 1] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_NE(probe_problem(6, 4, radiance).find("pixel (5, 2), channel G: radiance is nan"),
            std::string::npos);
  radiance[3 * (2 * 6 + 5) + 1] = std::numeric_limits<float>::infinity();
  EXPECT_NE(probe_problem(6, 4, radiance).find("is inf"), std::string::npos);
  EXPECT_NE(probe_problem(4, 4, radiance).find("72 values, not 48"), std::string::npos);
  EXPECT_NE(probe_problem(0, 4, radiance).find("0 x 4"), std::string::npos);
  EXPECT_EQ(probe_problem(1, 1, {0, 0, 0}), "the probe is black");
}

}  // namespace
}  // namespace scattermeter
