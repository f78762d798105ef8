#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/apps/small_rig.h"

namespace scattermeter::apps {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(SimulateCommand, WantsTruth) {
  SmallRig rig;
  rig.write(replaced(rig.text(), "    PE: {sigma_s", "    XX: {sigma_s"));
  const Answer r = run({"simulate", rig.rig(), "--out", rig.shots()});
  EXPECT_EQ(r.status, 2);
  EXPECT_THAT(r.err, HasSubstr("truth.materials.PE"));
  EXPECT_FALSE(std::filesystem::exists(rig.shots()));
}

// An LED that points away, and a time that is much too long.
TEST(SimulateCommand, TellsDarkAndClippedShots) {
  SmallRig rig;
  rig.keep_shots("PE_cube");
  const std::string kept = rig.text();
  rig.write(replaced(kept, "axis: [-30, 60, -70]", "axis: [30, -60, 70]"));
  Answer r = run({"simulate", rig.rig(), "--out", rig.shots()});
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.err, AllOf(HasSubstr("PE_cube_1.dng: is dark"), Not(HasSubstr("PE_cube_2.dng"))));
  EXPECT_THAT(r.out, HasSubstr("2 shots written to " + rig.shots() + ", exposed for 0.05 s"));

  rig.write(replaced(kept, "exposure_s: 0.05", "exposure_s: 0.5"));
  r = run({"simulate", rig.rig(), "--out", rig.shots()});
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.err, AllOf(HasSubstr("PE_cube_1.dng: clips"), HasSubstr("exposed for 0.5 s")));
}

}  // namespace
}  // namespace scattermeter::apps
