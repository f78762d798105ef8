#include <gtest/gtest.h>

#include "tests/fixtures/apps/checked_small_rig.h"

namespace scattermeter::apps {
namespace {

// The camera wrote it down.
TEST(CheckSettings, ApertureAndIsoChanged) {
  SmallRig rig;
  rig.keep_shots("POM_cube");
  rig.simulate();
  reshoot(rig, "POM_cube_2", "  exposure_s: 0.05\n",
          "  exposure_s: 0.05\n  f_number: 5.6\n  iso: 200\n");
  const Checked c = check(rig);
  EXPECT_EQ(c.answer.status, 1);
  EXPECT_EQ(c.verdict("aperture"), "fail");
  EXPECT_EQ(c.verdict("ISO setting"), "fail");
}

}  // namespace
}  // namespace scattermeter::apps
