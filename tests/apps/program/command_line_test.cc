#include "apps/program/command_line.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/apps/small_rig.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

TEST(CommandLine, HelpNamesEveryCommand) {
  const Answer r = run({"--help"});
  EXPECT_EQ(r.status, 0);
  for (const char* word : {"init", "print", "measure", "check", "simulate", "plan", "render",
                           "compare", "export", "bench", "--threads", "--quiet", "--version"}) {
    EXPECT_THAT(r.out, HasSubstr(word));
  }
  for (const char* command : {"measure", "check", "simulate", "plan"}) {
    const Answer help = run({command, "--help"});
    EXPECT_EQ(help.status, 0);
    EXPECT_THAT(help.out, HasSubstr("rig"));
  }
}

TEST(CommandLine, BadUsageIsStatusTwo) {
  EXPECT_EQ(run({}).status, 2);
  EXPECT_EQ(run({"measure"}).status, 2);
  EXPECT_EQ(run({"bake", "x"}).status, 2);
  EXPECT_EQ(run({"measure", "x", "--rig", "y", "--model", "guess"}).status, 2);
  EXPECT_EQ(run({"--threads", "0", "measure", "x", "--rig", "y"}).status, 2);
  EXPECT_THAT(run({"measure", "x", "--rig", "y", "--modle", "dipole"}).err, HasSubstr("--modle"));
}

TEST(CommandLine, Version) {
  const Answer r = run({"--version"});
  EXPECT_EQ(r.status, 0);
  EXPECT_THAT(r.out, HasSubstr("scattermeter 0."));
  for (const char* library : {"Ceres 2", "CLI11 2", "Eigen 3", "Embree 3", "LibRaw 0", "libtiff 4",
                              "nlohmann-json 3", "oneTBB 2", "OpenCV 4", "yaml-cpp 0"}) {
    EXPECT_THAT(r.out, HasSubstr(library));
  }
}

TEST(CommandLine, QuietPrintsNothing) {
  SmallRig rig;
  rig.keep_shots("PE_cube_1");
  EXPECT_EQ(run({"simulate", rig.rig(), "--out", rig.shots(), "--quiet"}).out, "");
  const Answer r = rig.measure({"-q"});
  EXPECT_EQ(r.out + r.err, "");
  EXPECT_EQ(r.status, 0);
  // The command stands in the result as it can be given to a shell again.
  EXPECT_THAT(rig.result(), HasSubstr("\"command\": \"scattermeter measure " + rig.shots()));
}

}  // namespace
}  // namespace scattermeter::apps
