#include "apps/program/command_line.h"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/apps/small_rig.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

TEST(CommandLine, HelpNamesEveryCommand) {
  const Answer r = run({"--help"});
  EXPECT_EQ(r.status, 0);
  for (const char* word : {"measure", "check", "simulate", "plan", "render", "export", "bench",
                           "--threads", "--quiet", "--version"}) {
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

// One line that begins with the program's name and says what was meant, and one on --help.
TEST(CommandLine, UsageErrorsSuggestWhatWasMeant) {
  const auto told = [](const std::vector<std::string>& words) {
    const Answer r = run(words);
    EXPECT_EQ(r.status, 2);
    EXPECT_EQ(r.out, "");
    EXPECT_THAT(r.err, ::testing::StartsWith("scattermeter: "));
    EXPECT_THAT(r.err, ::testing::EndsWith(" --help` for its options.\n"));
    EXPECT_EQ(std::count(r.err.begin(), r.err.end(), '\n'), 2);
    return r.err;
  };
  EXPECT_THAT(told({"mesure", "shots"}),
              HasSubstr("mesure is no command; did you mean measure? (there are: measure, check,"));
  EXPECT_THAT(told({"--threads", "2", "chekc", "x"}), HasSubstr("did you mean check?"));
  EXPECT_THAT(told({"calibrate", "camra", "x"}),
              HasSubstr("camra is no command; did you mean camera?"));
  EXPECT_THAT(told({"bake", "x"}), HasSubstr("bake is no command (there are"));
  EXPECT_THAT(told({"measure", "x", "--modle", "dipole"}),
              HasSubstr("--modle is no option of measure; did you mean --model?"));
  EXPECT_THAT(told({"measure", "x", "--thread=2"}), HasSubstr("did you mean --threads?"));
  EXPECT_THAT(
      told({"measure", "x", "--rig", "y", "--model", "dipol"}),
      HasSubstr("--model: expected one of auto, transport, dipole, paper, got dipol; did you "
                "mean dipole?"));
  EXPECT_THAT(told({"export", "x", "--out", "y", "--format", "pbrtt"}),
              HasSubstr("did you mean pbrt?"));
  EXPECT_THAT(told({"measure", "x"}), HasSubstr("--rig is required\nRun `scattermeter measure "));
  EXPECT_THAT(told({}), HasSubstr("A subcommand is required"));
  EXPECT_THAT(told({"--threads", "0", "measure", "x", "--rig", "y"}), HasSubstr("--threads"));
  // Negative numbers and what follows an option are no options.
  EXPECT_THAT(told({"export", "x", "--out", "--modle", "--g", "-2", "--format", "csv"}),
              HasSubstr("--g"));
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
