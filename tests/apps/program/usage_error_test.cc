#include "apps/program/usage_error.h"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/apps/small_rig.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

// One line that begins with the program's name and says what was meant, and one on --help.
TEST(UsageError, SuggestsWhatWasMeant) {
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
              HasSubstr("mesure is no command; did you mean measure? (there are: init, print, "
                        "measure, check,"));
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
  EXPECT_THAT(told({}), HasSubstr("name what to do: "));
  EXPECT_THAT(told({"--threads", "0", "measure", "x", "--rig", "y"}),
              HasSubstr("--threads: expected a positive number, got 0"));
  EXPECT_THAT(told({"measure", "x", "--rig", "y", "--channels", "g"}),
              HasSubstr("did you mean G?"));
  const auto measuring = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"measure", "x", "--rig", "y"});
    return told(more);
  };
  EXPECT_THAT(measuring({"--paths", "1e6"}),
              HasSubstr("--paths: expected a whole number, written in digits, from 300000 to "
                        "1000000000000, got 1e6"));
  EXPECT_THAT(measuring({"--paths", "1"}), HasSubstr("expected a number from 300000"));
  EXPECT_THAT(measuring({"--patch-size"}), HasSubstr("--patch-size: needs a value"));
  EXPECT_THAT(measuring({"--rig", "z"}), HasSubstr("--rig: is given more than once"));
  EXPECT_THAT(told({"plan", "x", "--sigma-s-prime", "1"}),
              HasSubstr("--sigma-s-prime: needs at least 2 values, got 1"));
  EXPECT_THAT(told({"calibrate"}), HasSubstr("name what to calibrate: camera, led, radiance"));
  // Negative numbers and what follows an option are no options.
  EXPECT_THAT(told({"export", "x", "--out", "--modle", "--g", "-2", "--format", "csv"}),
              HasSubstr("--g"));
}

}  // namespace
}  // namespace scattermeter::apps
