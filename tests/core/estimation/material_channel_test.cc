#include "core/estimation/material_channel.h"

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/input_error.h"
#include "tests/fixtures/core/dipole_cube.h"

namespace scattermeter {
namespace {

using ::testing::HasSubstr;

TEST(MaterialChannel, MaterialsFollowTheirFirstShots) {
  test_support::DipoleCube cube(2);
  cube.scene.shots[1].material = "wax";
  const auto all = material_channels(cube.scene, cube.shots);
  ASSERT_EQ(all.size(), 6U);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(all[i].material, i < 3 ? "POM" : "wax");
    EXPECT_EQ(all[i].channel, i % 3);
    ASSERT_EQ(all[i].shots.size(), 1U);
    EXPECT_EQ(all[i].shots[0], &cube.shots[i / 3]);
    EXPECT_EQ(all[i].eta_int_over_ext, 1.3);
  }
}

TEST(MaterialChannel, ShotsOfOneMaterialAreTogetherAndChannelsAreChosen) {
  const test_support::DipoleCube cube(2, 4.0);
  const auto blue = material_channels(cube.scene, cube.shots, "B");
  ASSERT_EQ(blue.size(), 1U);
  EXPECT_EQ(blue[0].channel, 2U);
  EXPECT_EQ(blue[0].shots.size(), 2U);
  EXPECT_DOUBLE_EQ(patch_size_mm(blue[0]), 4.0);
  EXPECT_EQ(material_channels(cube.scene, cube.shots, "RG").size(), 2U);
}

TEST(MaterialChannel, OneMaterialHasOneEta) {
  test_support::DipoleCube cube(2);
  SceneObject other = cube.scene.objects[0];
  other.eta_int_over_ext = 1.5;
  ObjectScene object;
  object.stated = &other;
  const auto seen = std::make_shared<SeenObject>(*cube.shots[1].seen);
  seen->object = &object;
  cube.shots[1].seen = seen;
  cube.scene.shots[1].line = 9;
  try {
    material_channels(cube.scene, cube.shots);
    FAIL() << "two eta were accepted";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("rig.yaml:9"));
    EXPECT_THAT(e.what(), HasSubstr("POM has eta 1.5 here but 1.3"));
  }
}

// Of a shot of ten rows.
TEST(MaterialChannel, StatesWhatMakesAShotUseless) {
  SceneShot stated;
  stated.file = "a.dng";
  ObservedShot shot;
  shot.stated = &stated;
  shot.exposure_s = 0.25;
  EXPECT_EQ(shot_problem(shot, 1), "a.dng: no whole patch of the object is seen");
  ChannelObservation& o = shot.observation.channel[1];
  o.l.assign(10, 1.0);
  o.brightest_snr = 11.0;
  o.rows_clipped = 5;
  EXPECT_EQ(shot_problem(shot, 1), "");
  o.rows_clipped = 6;
  EXPECT_EQ(shot_problem(shot, 1),
            "a.dng: channel G is clipped on 60 % of the object (exposure 0.25 s)");
  o.rows_clipped = 0;
  o.brightest_snr = 9.0;
  o.brightest_counts = 3.0;
  EXPECT_EQ(
      shot_problem(shot, 1),
      "a.dng: channel G is dark, brightest patch 3.0 counts above black, 9 times its noise as "
      "camera.sensor states it");
  o.brightest_snr = 50.0;
  o.noise_excess = 100.0;
  EXPECT_THAT(shot_problem(shot, 1), HasSubstr("a.dng: channel G is 10 times as noisy as the rig "
                                               "states, its brightest patch only 5 times"));
  o.noise_excess = 16.0;
  EXPECT_EQ(shot_problem(shot, 1), "");
}

TEST(MaterialChannel, HasOnePhaseFunction) {
  test_support::DipoleCube cube(2);
  cube.scene.objects[0].phase = 0.7;
  cube.scene.objects[0].gamma_std = 0.2;
  const MaterialChannel channel = material_channels(cube.scene, cube.shots, "R").front();
  EXPECT_EQ(channel.phase, PhaseFunction(0.7));
  EXPECT_EQ(channel.gamma_std, 0.2);
}

TEST(MaterialChannel, CoefficientsAreAsUncertainAsLengths) {
  test_support::DipoleCube cube;
  cube.show(test_support::kCubeMedium);
  const MaterialChannel channel = material_channels(cube.scene, cube.shots, "R").front();
  Estimate exact;
  exact.sigma_s_prime_per_mm = normal_quantity(2.0, 0.003);
  exact.sigma_a_per_mm = normal_quantity(0.01, 0.0002);
  exact.correlation = -0.5;
  Estimate e = exact;
  apply_mesh_scale(channel, e);
  EXPECT_EQ(e.sigma_s_prime_per_mm.std, exact.sigma_s_prime_per_mm.std);
  EXPECT_TRUE(e.budget.empty());
  cube.scene.objects[0].scale_relative_std = 0.002;
  apply_mesh_scale(channel, e);
  EXPECT_NEAR(e.sigma_s_prime_per_mm.std, std::hypot(0.003, 0.004), 1e-15);
  EXPECT_NEAR(e.sigma_a_per_mm.std, std::hypot(0.0002, 0.00002), 1e-15);
  // Covariances add up: -0.5 * 0.003 * 0.0002 + 0.004 * 0.00002.
  EXPECT_NEAR(e.correlation * e.sigma_s_prime_per_mm.std * e.sigma_a_per_mm.std, -2.2e-7, 1e-15);
  EXPECT_NEAR(e.sigma_s_prime_per_mm.high95, 2.0 + 1.96 * 0.005, 1e-12);
  ASSERT_EQ(e.budget.size(), 1U);
  EXPECT_EQ(e.budget[0].cause, "mesh scale");
  EXPECT_NEAR(e.budget[0].std_sigma_s_prime_per_mm, 0.004, 1e-15);
  // An outline that does not tell cut edges from another size leaves more open.
  cube.shots[0].size_open_relative = 0.0015;
  Estimate open = exact;
  apply_mesh_scale(channel, open);
  ASSERT_EQ(open.budget.size(), 1U);
  EXPECT_NEAR(open.budget[0].std_sigma_s_prime_per_mm, 2.0 * 0.0025, 1e-15);
}

// The image shows a body that is larger than its mesh: its coefficients are smaller.
TEST(MaterialChannel, CoefficientsAreThoseOfTheSizeThatTheImageTells) {
  test_support::DipoleCube cube;
  cube.show(test_support::kCubeMedium);
  cube.scene.objects[0].scale_relative_std = 0.002;
  const MaterialChannel channel = material_channels(cube.scene, cube.shots, "R").front();
  Estimate e;
  e.sigma_s_prime_per_mm = normal_quantity(2.0, 0.003);
  e.sigma_a_per_mm = normal_quantity(0.01, 0.0002);
  PriorPull size;
  size.name = cube.scene.objects[0].name + ".size";
  size.offset = 0.005;
  PriorPull other;
  other.name = "eta";
  other.offset = 0.1;
  e.pulls = {other, size};
  apply_mesh_scale(channel, e);
  EXPECT_NEAR(e.sigma_s_prime_per_mm.value, 2.0 / 1.005, 1e-12);
  EXPECT_NEAR(e.sigma_a_per_mm.value, 0.01 / 1.005, 1e-12);
  EXPECT_NEAR(e.sigma_s_prime_per_mm.std, 0.005 / 1.005, 1e-12);
  EXPECT_NEAR(e.sigma_s_prime_per_mm.high95 - e.sigma_s_prime_per_mm.value, 1.96 * 0.005 / 1.005,
              1e-12);
}

}  // namespace
}  // namespace scattermeter
