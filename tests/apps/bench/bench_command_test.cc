#include <gtest/gtest.h>

#include "tests/fixtures/apps/small_rig.h"

namespace scattermeter::apps {
namespace {

TEST(BenchCommand, BadUsage) {
  EXPECT_EQ(run({"bench"}).status, 2);
  EXPECT_EQ(run({"bench", "nothing"}).status, 2);
  EXPECT_EQ(run({"bench", "noise", "--seeds", "1"}).status, 2);
  EXPECT_EQ(run({"bench", "rig", "--image-width", "10"}).status, 2);
  EXPECT_EQ(run({"bench", "noise", "--rig", "/nowhere/rig.yaml"}).status, 2);
}

}  // namespace
}  // namespace scattermeter::apps
