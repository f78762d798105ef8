#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/apps/small_rig.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

TEST(SimulateCommand, WantsTruth) {
  SmallRig rig;
  rig.write(replaced(rig.text(), "    PE: {sigma_s", "    XX: {sigma_s"));
  const Answer r = run({"simulate", rig.rig(), "--out", rig.shots()});
  EXPECT_EQ(r.status, 2);
  EXPECT_THAT(r.err, HasSubstr("truth.materials.PE"));
  EXPECT_FALSE(std::filesystem::exists(rig.shots()));
}

}  // namespace
}  // namespace scattermeter::apps
