#include "core/nuisances/light_sensitivity.h"

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/tangents.h"
#include "core/estimation/channel_weights.h"
#include "core/material/fresnel.h"
#include "tests/fixtures/core/dipole_cube.h"

namespace scattermeter {
namespace {

// The cube under an LED of which position and exponent are uncertain, and eta as well.
class LightSensitivityOfTheCube : public ::testing::Test {
 protected:
  explicit LightSensitivityOfTheCube(double patch_mm = 1.25)  // about a mean free path
      : cube_(1, patch_mm) {
    cube_.scene.objects[0].eta_std = 0.01;
    cube_.scene.lights[0].led()->position_std_mm = 0.3;
    cube_.scene.lights[0].led()->exponent_std = 0.05;
    add_smooth_weights(cube_.scene, cube_.shots, cube_.lit, nullptr, cube_.weights);
  }

  const SeenObject& seen() const { return *cube_.shots[0].seen; }
  const WeightMatrix& nominal() const { return cube_.weights.at({&seen(), "led", 0}); }
  LightSensitivity sensitivity_of_medium() {
    const std::vector<LitMedium> media = {{test_support::kCubeMedium, 1.0}};
    return sensitivity(seen(), nominal(),
                       changed_images(seen(), cube_.scene.lights[0], 0, cube_.lit, knots_, media),
                       media, knots_);
  }

  // The full forward model: as fine as that of the fit.
  Eigen::VectorXd model(const LedLight& light, double eta, std::size_t tangent = 0,
                        double shift_mm = 0.0) const {
    std::vector<ExitSite> sites;
    for (std::size_t j = 0; j < seen().sites.size(); ++j) {
      const auto along = tangents(seen().patches->normal(seen().map.patch_of_row[j]));
      sites.push_back(moved(seen().sites[j], shift_mm * along[tangent]));
    }
    const IncidentLight lit =
        light.illuminate(*seen().patches, *seen().object->rays, eta, LightUse::kMeasure)[0];
    Medium medium = test_support::kCubeMedium;
    medium.eta_int_over_ext = eta;
    const double t = medium.sigma_t_prime_per_mm();
    return smooth_weights(sites, SourceCloud(lit, seen().object->box.center_mm()), knots_,
                          pair_options(knots_)) *
           dipole_curve(knots_, std::log(t), medium.sigma_a_per_mm / t, eta).r;
  }

  // Relative to the length of the difference quotient.
  static double departure(const Eigen::MatrixXd& derivative, const Eigen::VectorXd& high,
                          const Eigen::VectorXd& low, double step) {
    const Eigen::VectorXd expected = (high - low) / step;
    return (derivative.col(0) - expected).norm() / expected.norm();
  }

  test_support::DipoleCube cube_;
  DistanceKnots knots_ = smooth_knots(cube_.lit);
};

class LightSensitivityOfManyRows : public LightSensitivityOfTheCube {
 protected:
  LightSensitivityOfManyRows() : LightSensitivityOfTheCube(0.5) {}
};

TEST_F(LightSensitivityOfTheCube, MatchesCentralDifferencesByTheLight) {
  const LightSensitivity s = sensitivity_of_medium();
  const LedLight& led = *cube_.scene.lights[0].led();
  EXPECT_LT((s.l.col(0) - model(led, 1.3)).norm(), 1e-9 * s.l.norm());
  ASSERT_EQ(s.per_change.size(), 4U);  // x, y, z, exponent
  for (Eigen::Index i = 0; i < 3; ++i) {
    LedLight high = led, low = led;
    high.led.position_mm[i] += 0.5;
    low.led.position_mm[i] -= 0.5;
    EXPECT_LT(departure(s.per_change[static_cast<std::size_t>(i)], model(high, 1.3),
                        model(low, 1.3), 1.0),
              0.03)  // measured: 0.016
        << i;
  }
  LedLight high = led, low = led;
  high.led.exponent += 0.05;
  low.led.exponent -= 0.05;
  // l times the logarithm of the lobe's cosine: a hundredth of l, so that the error of patches of
  // twice the size counts for more. Measured: 0.052.
  EXPECT_LT(departure(s.per_change[3], model(high, 1.3), model(low, 1.3), 0.1), 0.1);
}

// Of many rows, changes of the light are interpolated between some. Measured: within 0.006.
TEST_F(LightSensitivityOfManyRows, IsInterpolatedBetweenSomeOfThem) {
  SeenObject apart = seen();
  apart.map.adjacent_rows.clear();
  const std::vector<LitMedium> media = {{test_support::kCubeMedium, 1.0}};
  const auto images = [&](const SeenObject& view) {
    return changed_images(view, cube_.scene.lights[0], 0, cube_.lit, knots_, media);
  };
  const ChangedImages some = images(seen()), all = images(apart);
  EXPECT_LT(some.some.rows.size(), all.some.rows.size() / 2);
  const LightSensitivity by_some = sensitivity(seen(), nominal(), some, media, knots_);
  const LightSensitivity by_all = sensitivity(seen(), nominal(), all, media, knots_);
  const auto expect_near = [](const Eigen::MatrixXd& found, const Eigen::MatrixXd& expected) {
    EXPECT_LT((found - expected).norm(), 0.01 * expected.norm());
  };
  for (std::size_t k = 0; k < 4; ++k) expect_near(by_some.per_change[k], by_all.per_change[k]);
  expect_near(by_some.per_eta, by_all.per_eta);
  for (std::size_t t = 0; t < 2; ++t) {
    EXPECT_EQ(by_some.per_tangent_mm[t], by_all.per_tangent_mm[t]);
  }
}

// At the sites' centres instead of over them: measured 0.086, and 0.16 with patches of two mean
// free paths.
TEST_F(LightSensitivityOfTheCube, MatchesCentralDifferencesByMovingTheSites) {
  const LightSensitivity s = sensitivity_of_medium();
  const LedLight& led = *cube_.scene.lights[0].led();
  for (std::size_t t = 0; t < 2; ++t) {
    EXPECT_LT(
        departure(s.per_tangent_mm[t], model(led, 1.3, t, 0.05), model(led, 1.3, t, -0.05), 0.1),
        0.1)
        << t;
  }
}

// By eta both the predicted l and the observed one, pi L / Ft, change.
class LightSensitivityByEta : public LightSensitivityOfTheCube {
 protected:
  // The l that would be observed with the stated eta if the material had this one.
  Eigen::VectorXd observed(double eta) const {
    Eigen::VectorXd l = model(*cube_.scene.lights[0].led(), eta);
    for (std::size_t j = 0; j < seen().sites.size(); ++j) {
      const double cos_theta =
          seen()
              .patches->normal(seen().map.patch_of_row[j])
              .dot((seen().camera_center_mm - seen().sites[j].center_mm).normalized());
      const auto row = static_cast<Eigen::Index>(j);
      l[row] *= fresnel_transmittance(eta, cos_theta) / fresnel_transmittance(1.3, cos_theta);
    }
    return l;
  }
};

TEST_F(LightSensitivityByEta, MatchesCentralDifferences) {
  const LightSensitivity s = sensitivity_of_medium();
  EXPECT_LT(departure(s.per_eta, observed(1.305), observed(1.295), 0.01), 0.01);
}

// Over 0.1, the change is not linear: measured 0.047 and 0.048 off; by its own step, 0.002.
TEST_F(LightSensitivityByEta, FarOffIsThatOfItsOwnStep) {
  const LightSensitivity s = sensitivity_of_medium();
  const std::vector<LitMedium> media(3, {test_support::kCubeMedium, 1.0});
  LightSensitivity far = sensitivity(
      seen(), nominal(), changed_images(seen(), cube_.scene.lights[0], 0, cube_.lit, knots_, media),
      media, knots_);
  set_far_per_eta(seen(), cube_.scene.lights[0], 0, cube_.lit, knots_, media, {0.1, -0.1, 0.0},
                  far);
  const Eigen::VectorXd here = observed(1.3);
  for (const auto& [column, eta] : {std::pair{0, 1.4}, {1, 1.2}}) {
    const Eigen::VectorXd there = observed(eta);
    EXPECT_LT(departure(far.per_eta.col(column), there, here, eta - 1.3), 0.005) << eta;
    EXPECT_GT(departure(s.per_eta, there, here, eta - 1.3), 0.03) << eta;
  }
  EXPECT_LT((far.per_eta.col(2) - s.per_eta.col(0)).norm(), 1e-12 * s.per_eta.norm());
}

// The images of some media are those of W, which does not depend on the medium.
TEST_F(LightSensitivityOfTheCube, ImagesComeFromWeightsOrDirectly) {
  const std::vector<LitMedium> media = {{test_support::kCubeMedium, 1.0}, {{1.0, 0.02, 1.3}, 0.7}};
  const SceneLight& light = cube_.scene.lights[0];
  const ChangedImages direct = changed_images(seen(), light, 0, cube_.lit, knots_, media);
  const ChangedImages by_weights =
      changed_images(seen(), changed_weights(seen(), light, 0, cube_.lit, knots_), knots_, media);
  const auto same = [](const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
    ASSERT_EQ(a.cols(), 2);
    EXPECT_LT((a - b).norm(), 1e-12 * a.norm());
  };
  same(direct.nominal, by_weights.nominal);
  same(direct.other_eta, by_weights.other_eta);
  for (std::size_t t = 0; t < 2; ++t) same(direct.shifted[t], by_weights.shifted[t]);
  ASSERT_EQ(direct.changed.size(), by_weights.changed.size());
  for (std::size_t k = 0; k < direct.changed.size(); ++k) {
    same(direct.changed[k], by_weights.changed[k]);
    EXPECT_EQ(direct.steps[k], by_weights.steps[k]);
  }
  EXPECT_EQ(direct.shift_mm, by_weights.shift_mm);
}

TEST_F(LightSensitivityOfTheCube, WhatIsExactIsNotChanged) {
  cube_.scene.objects[0].eta_std = 0.0;
  cube_.scene.lights[0].led()->position_std_mm = 0.0;
  cube_.scene.lights[0].led()->exponent_std = 0.0;
  const LightSensitivity s = sensitivity_of_medium();
  EXPECT_TRUE(s.per_change.empty());
  EXPECT_EQ(s.per_eta.rows(), s.l.rows());            // eta is tested even if it is exact
  EXPECT_EQ(s.per_tangent_mm[0].rows(), s.l.rows());  // poses are always uncertain
}

TEST(LightSensitivity, TangentsAreARightHandedFrame) {
  for (const Eigen::Vector3d& axis :
       {Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(-1, 0, 0), Eigen::Vector3d(1, 2, -2)}) {
    const Eigen::Vector3d n = axis.normalized();
    const auto t = tangents(n);
    EXPECT_NEAR((t[0].cross(t[1]) - n).norm(), 0.0, 1e-14);
    EXPECT_NEAR(t[0].norm(), 1.0, 1e-14);
    EXPECT_NEAR(t[1].norm(), 1.0, 1e-14);
  }
}

}  // namespace
}  // namespace scattermeter
