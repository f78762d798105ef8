#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/apps/small_rig.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

TEST(BenchDeviationsCommand, PrintsItsTable) {
  SmallRig files;
  const std::string csv = files.out() + ".csv";
  const Answer r =
      run({"bench", "--image-width", "240", "deviations", "--kind", "none", "--kind",
           "veiling glare", "--rendering", "dipole", "--runs", "2", "--each", "--csv", csv});
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.out, HasSubstr("within what the rig states"));
  EXPECT_THAT(r.out, HasSubstr("plain"));
  EXPECT_THAT(slurp(csv), HasSubstr("sigma_a_error_in_std"));
}

TEST(BenchDeviationsCommand, ListsAndRefuses) {
  const Answer list = run({"bench", "deviations", "--list"});
  EXPECT_EQ(list.status, 0) << list.err;
  EXPECT_THAT(list.out, HasSubstr("mesh displaced in x"));
  EXPECT_THAT(list.out, HasSubstr("outline"));
  const Answer unknown = run({"bench", "deviations", "--kind", "nonsense"});
  EXPECT_EQ(unknown.status, 2);
  EXPECT_THAT(unknown.err, HasSubstr("veiling glare"));
  EXPECT_EQ(run({"bench", "deviations", "--runs", "0"}).status, 2);
}

}  // namespace
}  // namespace scattermeter::apps
