#include "apps/planning/expected_materials.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/input_error.h"

namespace scattermeter::apps {
namespace {

// Shots of two materials, of which one has a truth.
Rig two_materials() {
  Rig rig;
  rig.path = "rig.yaml";
  for (const char* material : {"known", "unknown"}) {
    SceneShot& shot = rig.scene.shots.emplace_back();
    shot.material = material;
  }
  rig.truth.materials["known"].fill({2.0, 0.01, 1.0});
  return rig;
}

constexpr ExpectedRange kScattering{0.5, 8.0};
constexpr ExpectedRange kAbsorption{0.0, 0.01};

TEST(ExpectedMaterials, AreTheTruthWithoutRanges) {
  Rig rig = two_materials();
  EXPECT_THROW(expected_materials(rig, {}, {}), InputError);
  EXPECT_THROW(expected_materials(rig, kScattering, {}), InputError);
  rig.scene.shots.pop_back();
  const std::vector<TruthMaterials> out = expected_materials(rig, {}, {});
  ASSERT_EQ(out.size(), 1U);
  ASSERT_EQ(out[0].size(), 1U);
  EXPECT_EQ(out[0].at("known")[2].sigma_s_prime_per_mm, 2.0);
  EXPECT_EQ(out[0].at("known")[2].sigma_a_per_mm, 0.01);
}

// The middle is geometric in sigma_s', sqrt(0.5 * 8) = 2, and arithmetic in sigma_a.
TEST(ExpectedMaterials, HaveAMiddleAndFourCorners) {
  const std::vector<TruthMaterials> out =
      expected_materials(two_materials(), kScattering, kAbsorption);
  ASSERT_EQ(out.size(), 5U);
  const double s[] = {2.0, 0.5, 0.5, 8.0, 8.0};
  const double a[] = {0.005, 0.0, 0.01, 0.0, 0.01};
  for (std::size_t i = 0; i < out.size(); ++i) {
    ASSERT_EQ(out[i].size(), 2U);
    for (const char* material : {"known", "unknown"}) {
      for (const Medium& m : out[i].at(material)) {
        EXPECT_NEAR(m.sigma_s_prime_per_mm, s[i], 1e-12) << i;
        EXPECT_NEAR(m.sigma_a_per_mm, a[i], 1e-15) << i;
      }
    }
  }
}

TEST(ExpectedMaterials, KeepTheTruthOfACoefficientWithoutRange) {
  Rig rig = two_materials();
  rig.scene.shots.pop_back();
  const std::vector<TruthMaterials> out = expected_materials(rig, {}, kAbsorption);
  ASSERT_EQ(out.size(), 3U);
  for (const TruthMaterials& materials : out) {
    EXPECT_EQ(materials.at("known")[0].sigma_s_prime_per_mm, 2.0);
  }
  EXPECT_EQ(out[2].at("known")[1].sigma_a_per_mm, 0.01);
  // A range of a single value has no corners.
  EXPECT_EQ(expected_materials(rig, ExpectedRange{1.0, 1.0}, ExpectedRange{0.0, 0.0}).size(), 1U);
}

TEST(ExpectedMaterials, RefuseInvalidRanges) {
  const Rig rig = two_materials();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const ExpectedRange& range :
       {ExpectedRange{2.0, 1.0}, ExpectedRange{-1.0, 1.0}, ExpectedRange{1.0, kInfinity},
        ExpectedRange{std::nan(""), 1.0}}) {
    EXPECT_THROW(expected_materials(rig, range, kAbsorption), std::invalid_argument);
    EXPECT_THROW(expected_materials(rig, kScattering, range), std::invalid_argument);
  }
  EXPECT_THROW(expected_materials(rig, ExpectedRange{0.0, 1.0}, kAbsorption),
               std::invalid_argument);
}

}  // namespace
}  // namespace scattermeter::apps
