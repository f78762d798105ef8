#include "apps/bench/bench_patches.h"

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "apps/simulation/bodies_rig.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

TEST(BenchPatches, SmallFrame) {
  const Medium medium{1.2, 0.003, 1.0};
  const Rig rig = bodies_rig(640, 1.4, {{"m", {medium, medium, medium}}});
  const ObjectScenes scenes = bodies_scenes(rig);
  const std::vector<PatchesBenchRow> rows =
      bench_patches("LEDs", rig, scenes, {.sizes_mm = {1.0, 1.5}});
  ASSERT_EQ(rows.size(), 6U);
  for (const PatchesBenchRow& row : rows) {
    EXPECT_EQ(row.refusal, "");
    EXPECT_LT(std::abs(row.error_sigma_s_prime), 0.005);
    EXPECT_LT(std::abs(row.error_sigma_a), 0.03);
    EXPECT_GT(row.samples_per_patch, 1.0);
  }
  const std::vector<PatchesBenchSpread> spread = patches_spread(rows);
  ASSERT_EQ(spread.size(), 3U);
  EXPECT_DOUBLE_EQ(spread[0].spread_sigma_a,
                   std::abs(rows[0].error_sigma_a - rows[3].error_sigma_a));
  EXPECT_THAT(patches_bench_table(rows), HasSubstr("within 0.1 % and 1 %"));
  const std::string csv = patches_bench_csv(rows);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 6);
}

}  // namespace
}  // namespace scattermeter::apps
