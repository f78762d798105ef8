#include <gmock/gmock.h>
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

TEST(BenchCommand, ChoicesAreNames) {
  using ::testing::HasSubstr;
  using ::testing::Not;
  const std::pair<const char*, const char*> choices[] = {
      {"deviations", "{both,dipole,volume}"},
      {"models", "{off,on}"},
      {"paper", "{angular_map,equirectangular,mirror_ball}"}};
  for (const auto& [bench, names] : choices) {
    const Answer help = run({"bench", bench, "--help"});
    EXPECT_THAT(help.out, HasSubstr(names));
    EXPECT_THAT(help.out, Not(HasSubstr("->")));
  }
  const Answer number = run({"bench", "deviations", "--list", "--rendering", "1"});
  EXPECT_EQ(number.status, 2);
  EXPECT_THAT(number.err, HasSubstr("dipole"));
}

}  // namespace
}  // namespace scattermeter::apps
