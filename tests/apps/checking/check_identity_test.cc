#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/apps/checked_small_rig.h"
#include "tests/fixtures/apps/made_checked_rig.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

TEST(CheckIdentity, LightsExchanged) {
  SmallRig rig;
  rig.keep_shots("PE_");
  rig.simulate();
  exchange(rig, "PE_cube_1.dng", "PE_cube_2.dng");
  const Checked c = check(rig);
  EXPECT_EQ(c.answer.status, 1);
  EXPECT_EQ(c.verdict("light in shot"), "fail") << c.answer.out;
  EXPECT_THAT(c.where("light in shot"), HasSubstr("PE_cube_"));
  EXPECT_THAT(c.where("light in shot"), HasSubstr("lit by led"));
}

TEST(CheckIdentity, ObjectsExchanged) {
  SmallRig rig;
  rig.keep_shots("PE_");
  rig.simulate();
  exchange(rig, "PE_cube_1.dng", "PE_pyramid_1.dng");
  const Checked c = check(rig);
  EXPECT_EQ(c.answer.status, 1);
  EXPECT_EQ(c.verdict("light in shot"), "fail") << c.answer.out;
  EXPECT_THAT(c.where("light in shot"), HasSubstr("of object"));
}

TEST(CheckIdentity, MaterialsExchanged) {
  SmallRig rig;
  rig.keep_shots("_cube_");
  rig.simulate();
  exchange(rig, "PP_cube_1.dng", "POM_cube_1.dng");
  const Checked c = check(rig);
  EXPECT_EQ(c.answer.status, 1);
  EXPECT_EQ(c.verdict("material in shot"), "fail") << c.answer.out;
  EXPECT_EQ(c.where("material in shot"), "PP_cube_1.dng and POM_cube_1.dng");
}

TEST(CheckIdentity, LightsExplainTheirShots) {
  MadeCheckedRig made(2);
  made.checked.fit.likeness = {{0.05, 0.01, "lit by led2", {}}, {0.02, 0.5, "", {}}};
  // Others explain a.dng five times better, but its own do well enough.
  CheckItem item = check_identity(made.checked)[0];
  EXPECT_EQ(item.what, "light in shot");
  EXPECT_TRUE(item.passed);
  EXPECT_EQ(item.worst, 1.0);
  made.checked.fit.likeness[0].own = 0.2;
  item = check_identity(made.checked)[0];
  EXPECT_FALSE(item.passed);
  EXPECT_NEAR(item.worst, 20.0, 1e-9);
  EXPECT_EQ(item.where, "a.dng looks lit by led2");
  // Badly explained by all: not the lights.
  made.checked.fit.likeness[0].best_other = 0.21;
  EXPECT_TRUE(check_identity(made.checked)[0].passed);
  // Of a shot that is of no use nothing is said.
  made.checked.fit.likeness[0].own = std::nan("");
  EXPECT_EQ(check_identity(made.checked)[0].details.size(), 1U);
}

// Two materials, two objects; the cubes are exchanged.
TEST(CheckIdentity, ExchangedMaterialsScatter) {
  MadeCheckedRig made(4);
  const auto fill = [&](const std::vector<double>& sigma_s_prime) {
    made.checked.fit.channels.clear();
    for (std::size_t m = 0; m < 2; ++m) {
      CheckedChannel& fitted = made.add_channel(1, {2 * m, 2 * m + 1});
      fitted.material = m == 0 ? "m" : "n";
      for (const std::size_t shot : fitted.shots) {
        ShotResult& single = fitted.singles.emplace_back();
        single.estimate.converged = true;
        single.estimate.sigma_s_prime_per_mm.value = sigma_s_prime[shot];
      }
    }
  };
  for (const std::size_t i : {2U, 3U}) made.rig.scene.shots[i].material = "n";
  for (const std::size_t i : {1U, 3U}) made.rig.scene.shots[i].object = "pyramid";
  fill({1.0, 1.01, 2.0, 2.02});
  CheckItem item = check_identity(made.checked)[1];
  EXPECT_EQ(item.what, "material in shot");
  EXPECT_TRUE(item.passed);
  fill({2.0, 1.0, 1.0, 2.0});
  item = check_identity(made.checked)[1];
  EXPECT_FALSE(item.passed);
  EXPECT_EQ(item.where, "a.dng and c.dng");
  // Every material's two answers lie ln 2 / 2 from their mean, in %; the exchange takes all of it.
  EXPECT_NEAR(item.worst, 50.0 * std::log(2.0), 1e-9);
  // No two shots of one object under one light: nothing to hold against.
  made.rig.scene.shots[0].lights = {"led2"};
  made.rig.scene.shots[3].lights = {"led2"};
  EXPECT_TRUE(check_identity(made.checked)[1].details.empty());
}

}  // namespace
}  // namespace scattermeter::apps
