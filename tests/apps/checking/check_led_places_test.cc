#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/apps/checked_small_rig.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

TEST(CheckLedPlaces, AnLedThatMovedByTwoMillimetres) {
  SmallRig rig;
  rig.keep_shots("PE_");
  rig.simulate();
  rig.write(replaced(rig.text(), "position_mm: [30, -60, 80]", "position_mm: [32, -60, 80]"));
  const Checked c = check(rig);
  EXPECT_EQ(c.answer.status, 1);
  EXPECT_EQ(c.verdict("LED place"), "fail") << c.answer.out;
  EXPECT_EQ(c.where("LED place"), "led1 along x");
  EXPECT_NEAR(c.items.at("LED place")["worst"].get<double>(), -2.0, 0.5);
}

}  // namespace
}  // namespace scattermeter::apps
