#include "core/nuisances/nuisances.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include <gtest/gtest.h>

#include "calib/pose/shot_pose.h"
#include "core/base/tangents.h"
#include "core/light/incident_light.h"
#include "core/material/dipole.h"
#include "tests/fixtures/apps/calibrated_nuisances.h"

namespace scattermeter::apps {
namespace {

// A cause too small to count is left out, and nothing of the answer tells.
TEST_F(CalibratedNuisances, WhatIsTooSmallToCountIsLeftOut) {
  Rig open = exact_;
  for (SceneLight& light : open.scene.lights) light.led()->position_std_mm = 0.3;
  Rig little = open;
  for (SceneLight& light : little.scene.lights) {
    light.led()->exponent_std = 1e-7;
    light.led()->intensity_relative_std = 1e-7;
  }
  const ChannelResult without = result(open);
  const ChannelResult with = result(little);
  ASSERT_TRUE(without.estimate.converged && with.estimate.converged);
  EXPECT_EQ(with.nuisances_negligible, without.nuisances_negligible + 2);  // of the shot's LED
  EXPECT_EQ(with.estimate.sigma_s_prime_per_mm.value, without.estimate.sigma_s_prime_per_mm.value);
  EXPECT_EQ(with.estimate.sigma_s_prime_per_mm.std, without.estimate.sigma_s_prime_per_mm.std);
  EXPECT_EQ(with.estimate.sigma_a_per_mm.std, without.estimate.sigma_a_per_mm.std);
  EXPECT_GT(part(with.estimate, "LED position"), 0.0);
  // A thousand times as much counts.
  for (SceneLight& light : little.scene.lights) light.led()->intensity_relative_std = 1e-4;
  const ChannelResult more = result(little);
  EXPECT_EQ(more.nuisances_negligible, without.nuisances_negligible + 1);
  EXPECT_GT(part(more.estimate, "LED power"), 0.0);
}

// What the three deviations of a light say, said as a covariance, gives the same answer.
TEST_F(CalibratedNuisances, AgreeWithTheSingleDeviations) {
  Rig single = exact_, joint = exact_;
  for (SceneLight& light : single.scene.lights) {
    light.led()->position_std_mm = 0.3;
    light.led()->exponent_std = 0.05;
    light.led()->intensity_relative_std = 0.02;
  }
  for (SceneLight& light : joint.scene.lights) {
    LedUncertainty u;
    u.tangents[0] = light.led()->led.axis.unitOrthogonal();
    u.tangents[1] = light.led()->led.axis.cross(u.tangents[0]);
    u.covariance.diagonal() << 0.09, 0.09, 0.09, 0, 0, 0.0025, 0.0004, 0.0004, 0.0004;
    light.led()->calibrated = u;
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
  for (SceneLight& light : joint.scene.lights) {
    light.led()->calibrated->covariance(3, 3) = light.led()->calibrated->covariance(4, 4) = 0.01;
  }
  EXPECT_GT(measured(joint).sigma_s_prime_per_mm.std, b.sigma_s_prime_per_mm.std);
}

// Shots of a camera that differs from the rig in one quantity, measured by the dipole in G with
// that quantity stated as exact and as uncertain.
class UncalibratedCamera : public CalibratedNuisances {
 protected:
  Estimate measured_by(const Rig& rig, const VirtualShots& shots) {
    MeasureOptions options;
    options.estimate.model = "dipole";
    Instrument instrument(rig, scenes_, options);
    const capture::FrameSource frames = [&](std::size_t i, std::size_t k) {
      return shots.frame(i, 1, k);
    };
    return instrument.measure(capture::shots_from(rig.scene, {0}, frames)).results.at(1).estimate;
  }
  // `named`: the nuisance. value: of the truth. std: of the rig, a quantity of its camera.
  void expect_found(const Rig& truth, const std::string& named, double value,
                    double SceneCamera::*std) {
    const VirtualShots shots(truth, scenes_, {.noise = true});
    Rig uncertain = exact_;
    uncertain.scene.camera.*std = std::abs(value);
    const Estimate exact = measured_by(exact_, shots);
    const Estimate open = measured_by(uncertain, shots);
    const auto pull = [&](const Estimate& e) {
      return std::find_if(e.pulls.begin(), e.pulls.end(),
                          [&](const PriorPull& p) { return p.name == named; });
    };
    EXPECT_EQ(pull(exact), exact.pulls.end());
    EXPECT_EQ(part(exact, named.c_str()), 0.0);
    ASSERT_NE(pull(open), open.pulls.end());
    EXPECT_NEAR(pull(open)->offset, value, 0.25 * std::abs(value));
    EXPECT_GT(part(open, named.c_str()), 0.0);
    const double without = measured(exact_).sigma_a_per_mm.value;
    const auto error = [&](const Estimate& e) {
      return std::abs(e.sigma_a_per_mm.value - without);
    };
    EXPECT_LT(error(open), 0.5 * error(exact));
    EXPECT_LT(error(open), 3.0 * open.sigma_a_per_mm.std);
  }
};

// Shots through a lens whose corners are darker are told from those of a flat frame, and the value
// moves with what is found.
TEST_F(UncalibratedCamera, LightFallsOffTowardsTheCorners) {
  constexpr double kLost = 0.2;
  Rig dark = exact_;
  for (std::vector<double>& radial : dark.truth.sensor.vignetting_radial) radial = {-kLost};
  expect_found(dark, "vignetting", -kLost, &SceneCamera::vignetting_std);
}

// So are those of a sensor that records too little of much light.
TEST_F(UncalibratedCamera, ResponseIsNotAStraightLine) {
  constexpr double kAtWhite = -0.02;
  Rig bent = exact_;
  bent.truth.sensor.non_linearity = kAtWhite;
  expect_found(bent, "non-linearity", kAtWhite, &SceneCamera::non_linearity_std);
}

// Distance and power that are known together only: far less is lost than if both were open.
TEST_F(CalibratedNuisances, CorrelationIsKept) {
  Rig tied = exact_, open = exact_;
  for (Rig* rig : {&tied, &open}) {
    for (SceneLight& light : rig->scene.lights) {
      LedUncertainty u;
      u.tangents[0] = light.led()->led.axis.unitOrthogonal();
      u.tangents[1] = light.led()->led.axis.cross(u.tangents[0]);
      // 2 mm farther away along the axis, and as much brighter as makes up for it.
      LedVector v = LedVector::Zero();
      v.head<3>() = -2.0 * light.led()->led.axis;
      v.tail<3>().setConstant(4.0 / light.led()->led.position_mm.norm());
      u.covariance = v * v.transpose();
      if (rig == &open) u.covariance = LedMatrix(u.covariance.diagonal().asDiagonal());
      light.led()->calibrated = u;
    }
  }
  const Estimate together = measured(tied);
  const Estimate apart = measured(open);
  ASSERT_TRUE(together.converged && apart.converged);
  EXPECT_LT(part(together, "LED calibration"), 0.5 * part(apart, "LED calibration"));
}

// Columns of LED and pose against differences of all that is measured with: patches, sites and
// their quadrature.
TEST_F(CalibratedNuisances, SensitivitiesByFullDifferences) {
  Rig rig = exact_;
  for (SceneLight& light : rig.scene.lights) {
    light.led()->position_std_mm = 0.3;
    light.led()->exponent_std = 0.05;
  }
  LitObjects library(rig.scene, scenes_, std::nullopt, 180.0);
  const SharedView view =
      see_all(rig.scene, scenes_, library, calib::pose_from_points(rig.scene, rig.pose));
  const DistanceKnots knots(library.smallest_patch_mm() / 16.0, library.longest_distance_mm());
  const SeenObject& seen = *view.objects.at(rig.scene.shots[0].object);
  const SceneLight& light = rig.scene.light(rig.scene.shots[0].lights.at(0));
  const double eta = seen.object->stated->eta_int_over_ext;
  const auto weights = [&](const std::vector<ExitSite>& sites, const Led& led) {
    const IncidentLight lit = illuminate(*seen.patches, *seen.object->rays, led, eta);
    return smooth_weights(sites, SourceCloud(lit, seen.object->box.center_mm()), knots,
                          pair_options(knots));
  };
  const WeightMatrix nominal = weights(seen.sites, light.led()->led);
  const LitMedium medium{{1.0 / seen.patches->patch_size_mm(), 0.001, eta}, 1.0};
  const LightSensitivity s = sensitivity(
      seen, nominal,
      changed_images(seen, changed_weights(seen, light, 0, library, knots), knots, {medium}),
      {medium}, knots);
  const Dipole dipole(medium.medium);
  Eigen::VectorXd r(knots.size());
  for (Eigen::Index i = 0; i < r.size(); ++i) {
    r[i] = dipole.reflectance_per_mm2(knots.knots_mm()[static_cast<std::size_t>(i)]);
  }
  const Eigen::VectorXd l = nominal * r;
  EXPECT_LT((s.l.col(0) - l).norm(), 1e-12 * l.norm());
  const auto expect_near = [&](const char* what, const Eigen::MatrixXd& found,
                               const WeightMatrix& up, const WeightMatrix& down, double by,
                               double limit) {
    const Eigen::VectorXd change = (up - down) * r / by;
    const double error = (found.col(0) - change).norm() / change.norm();
    std::printf("%s: %.2f %% off\n", what, 100.0 * error);
    EXPECT_LT(error, limit) << what;
  };
  for (int i = 0; i < 3; ++i) {
    Led moved = light.led()->led;
    moved.position_mm[i] += 1.0;
    expect_near("LED", s.per_change[static_cast<std::size_t>(i)], weights(seen.sites, moved),
                nominal, 1.0, 0.01);
  }
  const auto shifted = [&](std::size_t t, double by_mm) {
    std::vector<ExitSite> out = seen.sites;
    for (std::size_t j = 0; j < out.size(); ++j) {
      const Eigen::Vector3d& normal = seen.patches->normal(seen.map.patch_of_row[j]);
      out[j] = moved(out[j], by_mm * tangents(normal)[t]);
    }
    return weights(out, light.led()->led);
  };
  const double step_mm = 0.05 * seen.patches->patch_size_mm();
  for (std::size_t t = 0; t < 2; ++t) {
    expect_near("site", s.per_tangent_mm[t], shifted(t, step_mm), shifted(t, -step_mm),
                2.0 * step_mm, 0.05);
  }
}

}  // namespace
}  // namespace scattermeter::apps
