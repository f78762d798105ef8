#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/apps/small_rig.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

TEST(BenchPlanCommand, WritesItsTable) {
  SmallRig files;
  const Answer r =
      run({"bench", "plan", "--rigs", "1", "--image-width", "320", "--out", files.out()});
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.out, HasSubstr("forecast over stated deviation"));
  EXPECT_THAT(slurp(files.out() + "/plan.csv"), HasSubstr("sigma_a_stated_relative"));
  EXPECT_EQ(run({"bench", "plan", "--rigs", "0"}).status, 2);
}

}  // namespace
}  // namespace scattermeter::apps
