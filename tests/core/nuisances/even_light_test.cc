#include "core/nuisances/even_light.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "core/light/ambient_light.h"
#include "tests/fixtures/core/dipole_cube.h"

namespace scattermeter {
namespace {

// The coarse image agrees with that of an ambient light computed for a fit.
TEST(EvenLight, IsTheImageOfAmbientLight) {
  test_support::DipoleCube cube;
  cube.show(test_support::kCubeMedium);
  SceneLight ambient;
  ambient.name = "hall";
  AmbientLight even;
  even.radiance_W_per_mm2_sr.setOnes();
  ambient.kind = even;
  cube.scene.lights.push_back(ambient);
  SceneShot lit_evenly = cube.scene.shots.front();
  lit_evenly.lights = {"hall"};
  std::vector<ObservedShot> shots(1);
  shots[0].stated = &lit_evenly;
  shots[0].seen = cube.shots[0].seen;
  Weights weights;
  add_smooth_weights(cube.scene, shots, cube.lit, nullptr, weights);
  const DistanceKnots knots = smooth_knots(cube.lit);
  const Medium& m = test_support::kCubeMedium;
  const std::vector<LitMedium> media = {{m, 1.0}, {m, 2.0}};
  const double eta = cube.scene.objects[0].eta_int_over_ext;
  const Eigen::VectorXd exact = weights.begin()->second * scaled_curves(media, knots, eta).col(0);
  const Eigen::MatrixXd coarse = even_light_images(*cube.shots[0].seen, knots, media);
  ASSERT_EQ(coarse.rows(), exact.size());
  EXPECT_LT((coarse.col(0) - exact).norm(), 0.02 * exact.norm());
  EXPECT_LT((coarse.col(1) - 2.0 * coarse.col(0)).norm(), 1e-9 * exact.norm());
}

// The face towards more light is brighter, by up to two thirds of even light, others are not.
TEST(EvenLight, FromOneSideMore) {
  const test_support::DipoleCube cube;
  const SeenObject& seen = *cube.shots[0].seen;
  const DistanceKnots knots = smooth_knots(cube.lit);
  const std::vector<LitMedium> media = {{test_support::kCubeMedium, 1.0}};
  const Eigen::MatrixXd even = even_light_images(seen, knots, media);
  const auto along = light_from_axes_images(seen, knots, media, even);
  for (int k = 0; k < 3; ++k) {
    double towards = 0.0, aside = 0.0;
    int n_towards = 0, n_aside = 0;
    for (Eigen::Index row = 0; row < even.rows(); ++row) {
      const double n =
          seen.patches->normal(seen.map.patch_of_row[static_cast<std::size_t>(row)])[k];
      const double share = along[static_cast<std::size_t>(k)](row, 0) / even(row, 0);
      EXPECT_LT(std::abs(share), 2.0 / 3.0 + 0.02);
      if (std::abs(n) > 0.9) {
        towards += share * n;
        ++n_towards;
      } else {
        aside += share;
        ++n_aside;
      }
    }
    EXPECT_GE(towards, 0.3 * n_towards) << k;
    EXPECT_LE(std::abs(aside), 0.2 * n_aside) << k;
  }
}

TEST(EvenLight, IrradianceOfAFaceTowardsTheLeds) {
  test_support::DipoleCube cube;
  Led& led = cube.scene.lights[0].led()->led;
  const Eigen::Vector3d center = cube.objects.at("cube").box.center_mm();
  led.position_mm = center + Eigen::Vector3d(0, 0, 50);
  led.axis = {std::sin(0.5), 0.0, -std::cos(0.5)};
  led.exponent = 2.0;
  led.intensity_W_per_sr = {0.1, 0.2, 0.3};
  EXPECT_NEAR(facing_irradiance_W_per_mm2(cube.scene, cube.shots[0], 1),
              0.2 * std::pow(std::cos(0.5), 2.0) / 2500.0, 1e-12);
}

TEST(EvenLight, OfShotsUnderLedsThatListNoAmbientLight) {
  test_support::DipoleCube cube;
  EXPECT_FALSE(may_have_even_light(cube.scene, cube.shots[0]));
  cube.scene.even_light_share_std = 0.003;
  EXPECT_TRUE(may_have_even_light(cube.scene, cube.shots[0]));
  SceneLight ambient;
  ambient.name = "hall";
  ambient.kind = AmbientLight{};
  cube.scene.lights.push_back(ambient);
  cube.scene.shots[0].lights.push_back("hall");
  EXPECT_FALSE(may_have_even_light(cube.scene, cube.shots[0]));
  EXPECT_EQ(std::get<1>(even_light_key(cube.shots[0])), "");
}

}  // namespace
}  // namespace scattermeter
