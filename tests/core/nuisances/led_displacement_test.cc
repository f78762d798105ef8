#include "core/nuisances/led_displacement.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/fixtures/core/dipole_cube.h"

namespace scattermeter {
namespace {

class LedDisplacement : public ::testing::Test {
 protected:
  LedDisplacement() {
    led().position_std_mm = 1.0;
    led().exponent_std = 0.1;
  }
  LedLight& led() { return *cube_.scene.lights[0].led(); }
  LedsElsewhere found(const std::vector<PriorPull>& pulls) const {
    return leds_elsewhere(cube_.scene, cube_.shots, pulls);
  }

  test_support::DipoleCube cube_{2};
  // Pull and offset.
  std::vector<PriorPull> pulls_ = {{"led.position1", "LED position", 2.0, 1.5},
                                   {"led.exponent", "LED exponent", 1.0, 0.1},
                                   {"led2.position0", "LED position", 1.0, 9.0}};
};

TEST_F(LedDisplacement, IsThatOfThePulls) {
  const LedsElsewhere there = found(pulls_);
  ASSERT_EQ(there.displacements.size(), 1U);  // the other LED is exact
  const Eigen::VectorXd& by = there.displacements.at("led");
  ASSERT_EQ(by.size(), 4);
  EXPECT_EQ(by, (Eigen::Vector4d(0.0, 1.5, 0.0, 0.1)));
  const double distance_mm =
      (led().led.position_mm - cube_.shots[0].seen->object->box.center_mm()).norm();
  EXPECT_NEAR(there.bent, 3.0 * std::pow(1.5 / distance_mm, 2) + 0.1 * 0.01, 1e-12);
}

// There, nothing is left out; a pull that no one believes counts as one of three deviations.
TEST_F(LedDisplacement, IsFromTheStatedLed) {
  led().displace(found(pulls_).displacements.at("led"));
  EXPECT_NEAR(found(pulls_).bent, 0.0, 1e-12);
  pulls_[0].pull = 6.0;
  EXPECT_NEAR(found(pulls_).displacements.at("led")[1], 0.75, 1e-12);
  EXPECT_NEAR(found({}).displacements.at("led").norm(), 0.0, 1e-12);
}

TEST_F(LedDisplacement, LeavesCalibratedLeds) {
  led().calibrated.emplace();
  EXPECT_TRUE(found(pulls_).displacements.empty());
  EXPECT_EQ(found(pulls_).bent, 0.0);
}

}  // namespace
}  // namespace scattermeter
