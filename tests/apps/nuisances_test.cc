#include "apps/nuisances.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "apps/bodies_rig.h"
#include "apps/instrument.h"
#include "apps/plastics_rig.h"
#include "apps/virtual_shots.h"

namespace scattermeter::apps {
namespace {

double part(const Estimate& e, const std::string& cause) {
  for (const BudgetLine& line : e.budget) {
    if (line.cause == cause) return line.std_sigma_s_prime_per_mm;
  }
  return 0.0;
}

Rig one_shot() {
  Rig rig = plastics_rig(240);
  rig.shots.resize(1);
  return rig;
}

class CalibratedNuisances : public ::testing::Test {
 protected:
  CalibratedNuisances()
      : exact_(one_shot()),
        scenes_(bodies_scenes(exact_)),
        shots_(exact_, scenes_, {.noise = true, .quiet = true}) {}

  Estimate measured(const Rig& rig) const {
    MeasureOptions options;
    options.quiet = true;
    options.model = Model::kDipole;
    Instrument instrument(rig, scenes_, options);
    const FrameSource frames = [&](std::size_t i) { return shots_.frame(i, 1); };
    return instrument.measure(shots_from(rig, {0}, frames)).results.at(1).estimate;
  }

  Rig exact_;
  ObjectScenes scenes_;
  VirtualShots shots_;
};

// What the three deviations of a light say, said as a covariance, gives the same answer.
TEST_F(CalibratedNuisances, AgreeWithTheSingleDeviations) {
  Rig single = exact_, joint = exact_;
  for (RigLight& light : single.lights) {
    light.position_std_mm = 0.3;
    light.exponent_std = 0.05;
    light.power_relative_std = 0.02;
  }
  for (RigLight& light : joint.lights) {
    calib::LedUncertainty u;
    u.tangents[0] = light.led.axis.unitOrthogonal();
    u.tangents[1] = light.led.axis.cross(u.tangents[0]);
    u.covariance.diagonal() << 0.09, 0.09, 0.09, 0, 0, 0.0025, 0.0004, 0.0004, 0.0004;
    light.calibrated = u;
  }
  const Estimate a = measured(single);
  const Estimate b = measured(joint);
  ASSERT_TRUE(a.converged && b.converged);
  EXPECT_NEAR(a.sigma_s_prime_per_mm.value, b.sigma_s_prime_per_mm.value,
              1e-3 * a.sigma_s_prime_per_mm.std);
  EXPECT_NEAR(b.sigma_s_prime_per_mm.std / a.sigma_s_prime_per_mm.std, 1.0, 1e-3);
  EXPECT_NEAR(b.sigma_a_per_mm.std / a.sigma_a_per_mm.std, 1.0, 1e-3);
  EXPECT_GT(part(b, "LED calibration"), 0.0);
  EXPECT_GT(part(a, "LED position"), 0.0);

  // The axis counts, too.
  for (RigLight& light : joint.lights) {
    light.calibrated->covariance(3, 3) = light.calibrated->covariance(4, 4) = 0.01;
  }
  EXPECT_GT(measured(joint).sigma_s_prime_per_mm.std, b.sigma_s_prime_per_mm.std);
}

// Distance and power that are known together only: far less is lost than if both were open.
TEST_F(CalibratedNuisances, CorrelationIsKept) {
  Rig tied = exact_, open = exact_;
  for (Rig* rig : {&tied, &open}) {
    for (RigLight& light : rig->lights) {
      calib::LedUncertainty u;
      u.tangents[0] = light.led.axis.unitOrthogonal();
      u.tangents[1] = light.led.axis.cross(u.tangents[0]);
      // 2 mm farther away along the axis, and as much brighter as makes up for it.
      calib::LedVector v = calib::LedVector::Zero();
      v.head<3>() = -2.0 * light.led.axis;
      v.tail<3>().setConstant(4.0 / light.led.position_mm.norm());
      u.covariance = v * v.transpose();
      if (rig == &open) u.covariance = calib::LedMatrix(u.covariance.diagonal().asDiagonal());
      light.calibrated = u;
    }
  }
  const Estimate together = measured(tied);
  const Estimate apart = measured(open);
  ASSERT_TRUE(together.converged && apart.converged);
  EXPECT_LT(part(together, "LED calibration"), 0.5 * part(apart, "LED calibration"));
}

}  // namespace
}  // namespace scattermeter::apps
