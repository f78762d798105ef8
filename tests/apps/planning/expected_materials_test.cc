#include "apps/planning/expected_materials.h"

#include <limits>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/input_error.h"

namespace scattermeter::apps {
namespace {

// Materials PP, which the truth knows, and new, which it does not.
Rig rig_of(const std::vector<std::string>& materials) {
  Rig rig;
  rig.path = "rig.yaml";
  for (const std::string& material : materials) {
    SceneShot shot;
    shot.material = material;
    rig.scene.shots.push_back(shot);
  }
  rig.truth.materials["PP"] = {Medium{0.5, 0.003, 1.0}, Medium{0.6, 0.002, 1.0},
                               Medium{0.7, 0.004, 1.0}};
  return rig;
}

TEST(ExpectedMaterials, TheTruthAlone) {
  const std::vector<TruthMaterials> all = expected_materials(rig_of({"PP", "PP"}), {}, {});
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].size(), 1U);
  EXPECT_EQ(all[0].at("PP")[2].sigma_a_per_mm, 0.004);
  try {
    expected_materials(rig_of({"new"}), {}, ExpectedRange{0, 1});
    ADD_FAILURE() << "expected what nobody knows";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), ::testing::HasSubstr("rig.yaml: truth.materials.new: is missing"));
  }
}

// The geometric middle of sigma_s', the arithmetic one of sigma_a, then the four corners.
TEST(ExpectedMaterials, MiddleAndCornersOfTheRanges) {
  const std::vector<TruthMaterials> all =
      expected_materials(rig_of({"new"}), ExpectedRange{0.5, 2.0}, ExpectedRange{0.0, 0.01});
  ASSERT_EQ(all.size(), 5U);
  const double s[] = {1.0, 0.5, 0.5, 2.0, 2.0};
  const double a[] = {0.005, 0.0, 0.01, 0.0, 0.01};
  for (std::size_t i = 0; i < 5; ++i) {
    for (const Medium& m : all[i].at("new")) {
      EXPECT_NEAR(m.sigma_s_prime_per_mm, s[i], 1e-12) << i;
      EXPECT_NEAR(m.sigma_a_per_mm, a[i], 1e-12) << i;
    }
  }
}

// The other coefficient stays the truth's; a range of one value has no corners.
TEST(ExpectedMaterials, OneRange) {
  const std::vector<TruthMaterials> two =
      expected_materials(rig_of({"PP"}), {}, ExpectedRange{0.001, 0.003});
  ASSERT_EQ(two.size(), 3U);
  EXPECT_EQ(two[0].at("PP")[1].sigma_s_prime_per_mm, 0.6);
  EXPECT_NEAR(two[0].at("PP")[1].sigma_a_per_mm, 0.002, 1e-15);
  EXPECT_NEAR(two[2].at("PP")[0].sigma_a_per_mm, 0.003, 1e-15);
  EXPECT_EQ(expected_materials(rig_of({"PP"}), ExpectedRange{1, 1}, ExpectedRange{0, 0}).size(),
            1U);
}

TEST(ExpectedMaterials, RefusesWhatIsNoRange) {
  const Rig rig = rig_of({"PP"});
  EXPECT_THROW(expected_materials(rig, ExpectedRange{2, 1}, {}), std::invalid_argument);
  EXPECT_THROW(expected_materials(rig, ExpectedRange{0, 1}, {}), std::invalid_argument);
  EXPECT_THROW(expected_materials(rig, {}, ExpectedRange{-1, 1}), std::invalid_argument);
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_THROW(expected_materials(rig, {}, ExpectedRange{0, infinity}), std::invalid_argument);
}

}  // namespace
}  // namespace scattermeter::apps
