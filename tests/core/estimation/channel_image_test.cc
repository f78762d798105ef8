#include "core/estimation/channel_image.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/fit/method_errors.h"
#include "tests/fixtures/core/dipole_cube.h"

namespace scattermeter {
namespace {

// Green of two shots under an LED each, whose positions are uncertain.
class ImageOfTheCube : public ::testing::Test {
 protected:
  ImageOfTheCube() {
    for (SceneLight& light : cube_.scene.lights) {
      light.led()->position_std_mm = 0.3;
      light.led()->led.intensity_W_per_sr = {1.0, 2.0, 1.0};
    }
    cube_.show(test_support::kCubeMedium);
    channel_ = material_channels(cube_.scene, cube_.shots, "G").front();
    rows_ = channel_rows(cube_.scene, channel_);
  }

  void find_sensitivities() {
    for (const SceneLight& light : cube_.scene.lights) {
      const LightKey key{&seen(), light.name, 0};
      by_light_[key] = sensitivity(seen(), cube_.weights.at(key),
                                   changed_images(seen(), light, 0, cube_.lit, knots_, {medium_}),
                                   {medium_}, knots_);
      sensitivities_[key] = {&by_light_.at(key), 0};
    }
  }
  const SeenObject& seen() const { return *cube_.shots[0].seen; }

  test_support::DipoleCube cube_{2};
  DistanceKnots knots_ = smooth_knots(cube_.lit);
  LitMedium medium_{{0.9, 0.01, 1.0}, 1.0};
  MaterialChannel channel_;
  ChannelRows rows_;
  std::map<LightKey, LightSensitivity> by_light_;
  std::map<LightKey, ChannelSensitivity> sensitivities_;
};

TEST_F(ImageOfTheCube, ShotsHaveTheirRowsAndTheNuisancesOfTheirLight) {
  find_sensitivities();
  const ChannelImage image(cube_.scene, channel_, rows_, cube_.weights, knots_, medium_,
                           sensitivities_);
  EXPECT_EQ(image.shots(), 2U);
  // The six combinations of an exact pose change nothing.
  EXPECT_EQ(image.negligible_nuisances(), 6U);
  const std::vector<Nuisance>& all = image.nuisances();
  // Three coordinates of each LED; eta, which is exact and only tested; then errors of the method:
  // shared octaves, one of each shot.
  const Eigen::Index octaves = static_cast<Eigen::Index>(all.size()) - 7 - 2;
  ASSERT_GT(octaves, 2);
  for (std::size_t k = 0; k < all.size(); ++k) {
    EXPECT_EQ(all[k].fitted, k < 6);
    EXPECT_EQ(all[k].group, k < 6 ? "LED position" : k == 6 ? "eta" : "numerics");
  }
  for (std::size_t s = 0; s < 2; ++s) {
    const ShotSystem shot = image.shot(s);
    const DenseSystem rows =
        channel_system(cube_.scene, channel_, s, rows_[s], cube_.weights, 1.0 / 0.91);
    EXPECT_EQ(shot.system->l, rows.l);
    EXPECT_EQ(shot.system->std_l, rows.std_l);
    EXPECT_EQ(shot.system->weights, rows.weights);
    std::vector<Eigen::Index> expected;
    for (Eigen::Index i = 0; i < 3; ++i) expected.push_back(3 * static_cast<Eigen::Index>(s) + i);
    for (Eigen::Index o = 0; o <= octaves; ++o) expected.push_back(6 + o);
    expected.push_back(7 + octaves + static_cast<Eigen::Index>(s));
    EXPECT_EQ(shot.nuisances, expected);
    ASSERT_EQ(shot.system->nuisances.size(), expected.size());
    for (std::size_t k = 0; k < expected.size(); ++k) {
      EXPECT_EQ(shot.system->nuisances[k].name, all[static_cast<std::size_t>(expected[k])].name);
    }
    // An LED of 2 W/sr that moves along x.
    const LightSensitivity& light = by_light_.at({&seen(), s == 0 ? "led" : "led2", 0});
    Eigen::Index at = 0;
    for (std::size_t j = 0; j < rows_[s].l.size(); ++j) {
      if (rows_[s].state[j] != RowState::kUsed) continue;
      const double per_mm = 2.0 * light.per_change[0](static_cast<Eigen::Index>(j), 0);
      EXPECT_NEAR(shot.system->nuisance_columns(at++, 0), per_mm, 1e-12 * std::abs(per_mm));
    }
    EXPECT_EQ(at, shot.system->l.size());
  }
}

// An eta that one object states as exact, and another does not, is uncertain.
TEST_F(ImageOfTheCube, TheLargestStatedDeviationOfAQuantityCounts) {
  find_sensitivities();
  Scene uncertain = cube_.scene;
  uncertain.objects.front().eta_std = 0.02;
  const ObjectScenes objects = test_support::cube_objects(uncertain);
  auto other = std::make_shared<SeenObject>(seen());
  other->object = &objects.at("cube");
  const std::shared_ptr<const SeenObject> first = cube_.shots[0].seen;
  for (const SceneLight& light : cube_.scene.lights) {
    sensitivities_[{other.get(), light.name, 0}] = sensitivities_.at({first.get(), light.name, 0});
    cube_.weights[{other.get(), light.name, 0}] = cube_.weights.at({first.get(), light.name, 0});
  }
  cube_.shots[1].seen = other;
  const ChannelImage image(cube_.scene, channel_, rows_, cube_.weights, knots_, medium_,
                           sensitivities_);
  for (std::size_t s = 0; s < 2; ++s) {
    const std::vector<Nuisance>& own = image.shot(s).system->nuisances;
    const auto eta =
        std::find_if(own.begin(), own.end(), [](const Nuisance& n) { return n.name == "eta"; });
    ASSERT_NE(eta, own.end());
    EXPECT_EQ(eta->std, 0.02);
    EXPECT_TRUE(eta->fitted);
  }
}

// 1e-7 of the power changes rows of a deviation of 1e-3 by 1e-4 of it: some 0.002 in all.
TEST_F(ImageOfTheCube, NuisancesThatCannotMatterAreLeftOut) {
  for (SceneLight& light : cube_.scene.lights) light.led()->intensity_relative_std = 1e-7;
  find_sensitivities();
  const ChannelImage image(cube_.scene, channel_, rows_, cube_.weights, knots_, medium_,
                           sensitivities_);
  EXPECT_EQ(image.negligible_nuisances(), 6U + 2U);  // with the exact pose's
  for (const Nuisance& nuisance : image.nuisances()) EXPECT_NE(nuisance.group, "LED power");
  EXPECT_EQ(image.shot(0).nuisances.front(), 0);
}

// Light by way of the plane is not in W r: l is without it, at the albedo stated, and the error of
// the albedo is one nuisance of both shots.
TEST_F(ImageOfTheCube, LightByWayOfThePlaneIsSubtracted) {
  ScenePlane& plane = *cube_.scene.surroundings.plane;
  plane.albedo = {0.1, 0.2, 0.3};
  plane.albedo_std = {0.04, 0.05, 0.06};
  find_sensitivities();
  for (auto& [key, s] : by_light_) s.per_albedo = (std::get<1>(key) == "led" ? 0.3 : 0.6) * s.l;
  const ChannelImage image(cube_.scene, channel_, rows_, cube_.weights, knots_, medium_,
                           sensitivities_);
  Eigen::Index of_albedo = -1;
  for (std::size_t k = 0; k < image.nuisances().size(); ++k) {
    const Nuisance& nuisance = image.nuisances()[k];
    if (nuisance.group != "surroundings") continue;
    EXPECT_EQ(of_albedo, -1);
    EXPECT_EQ(nuisance.std, 0.05);
    of_albedo = static_cast<Eigen::Index>(k);
  }
  ASSERT_GE(of_albedo, 0);
  const Eigen::VectorXd by_plane = image.light_by_plane();
  Eigen::Index at = 0;
  for (std::size_t s = 0; s < 2; ++s) {
    const ShotSystem shot = image.shot(s);
    const DenseSystem rows =
        channel_system(cube_.scene, channel_, s, rows_[s], cube_.weights, 1.0 / 0.91);
    const auto own = std::find(shot.nuisances.begin(), shot.nuisances.end(), of_albedo);
    ASSERT_NE(own, shot.nuisances.end());
    const Eigen::VectorXd column = shot.system->nuisance_columns.col(own - shot.nuisances.begin());
    const LightSensitivity& light = by_light_.at({&seen(), s == 0 ? "led" : "led2", 0});
    Eigen::Index row = 0;
    for (std::size_t j = 0; j < rows_[s].l.size(); ++j) {
      if (rows_[s].state[j] != RowState::kUsed) continue;
      // 2 W/sr.
      const double change = 2.0 * light.per_albedo(static_cast<Eigen::Index>(j), 0);
      EXPECT_GT(change, 0.0);
      EXPECT_NEAR(column[row], change, 1e-12 * change);
      EXPECT_NEAR(by_plane[at], 0.2 * change, 1e-12 * change);
      EXPECT_NEAR(shot.system->l[row], rows.l[row] - 0.2 * change, 1e-12 * rows.l[row]);
      ++row;
      ++at;
    }
  }
  EXPECT_EQ(at, by_plane.size());
}

TEST_F(ImageOfTheCube, FirstImageHasNoNuisancesWithoutAmbientLight) {
  const FirstChannelImage image(cube_.scene, channel_, rows_, cube_.weights);
  EXPECT_TRUE(image.nuisances().empty());
  const ShotSystem shot = image.shot(1);
  EXPECT_TRUE(shot.nuisances.empty());
  const DenseSystem rows = channel_system(cube_.scene, channel_, 1, rows_[1], cube_.weights, 0.0);
  EXPECT_EQ(shot.system->l, rows.l);
  EXPECT_EQ(shot.system->std_l, rows.std_l);
}

// Even light of free strength in the second shot alone: a constant column there, of the mean l.
TEST_F(ImageOfTheCube, FirstImageTakesAmbientLightForAConstant) {
  SceneLight ambient;
  ambient.name = "room";
  AmbientLight kind;
  kind.radiance_std_W_per_mm2_sr.setConstant(std::numeric_limits<double>::infinity());
  ambient.kind = kind;
  cube_.scene.lights.push_back(ambient);
  cube_.scene.shots[1].lights.push_back("room");
  add_smooth_weights(cube_.scene, cube_.shots, cube_.lit, nullptr, cube_.weights);
  const FirstChannelImage image(cube_.scene, channel_, rows_, cube_.weights);
  ASSERT_EQ(image.nuisances().size(), 1U);
  EXPECT_TRUE(std::isinf(image.nuisances()[0].std) && image.nuisances()[0].fitted);
  EXPECT_TRUE(image.shot(0).nuisances.empty());
  const ShotSystem shot = image.shot(1);
  ASSERT_EQ(shot.nuisances, std::vector<Eigen::Index>{0});
  const Eigen::VectorXd first = image.shot(0).system->l;
  const double mean_l = (first.sum() + shot.system->l.sum()) /
                        static_cast<double>(first.size() + shot.system->l.size());
  EXPECT_LT((shot.system->nuisance_columns.col(0).array() - mean_l).abs().maxCoeff(),
            1e-12 * mean_l);
}

}  // namespace
}  // namespace scattermeter
