#include "apps/instrument/shot_summary.h"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/apps/small_rig.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(ShotSummary, TellsTheNoisiestShot) {
  SceneShot first, second;
  first.file = "a.dng";
  second.file = "b.dng";
  std::vector<ObservedShot> shots(2);
  shots[0].stated = &first;
  shots[1].stated = &second;
  EXPECT_EQ(noise_note(shots), "");
  shots[0].observation.channel[2].noise_excess = 1.5;
  shots[1].observation.channel[0].noise_excess = 4.02;
  EXPECT_THAT(noise_note(shots), HasSubstr("2 of 6 channels of shots"));
  EXPECT_THAT(noise_note(shots), HasSubstr("b.dng R the most (4 times the variance)"));
}

// Shots whose noise is half of what they have, by their rig: the noise that they have counts, and
// that is said.
TEST(ShotSummary, UnderstatedNoiseIsThatOfTheShots) {
  SmallRig rig;
  rig.keep_shots("PE_cube");
  rig.simulate();
  const Answer right = rig.measure();
  EXPECT_EQ(right.status, 0) << right.out << right.err;
  EXPECT_THAT(right.err, Not(HasSubstr("noisier than stated")));
  rig.write(replaced(rig.text(), "gain_e_per_count: 6.0", "gain_e_per_count: 24.0"));
  const Answer understated = rig.measure();
  EXPECT_EQ(understated.status, 0) << understated.out << understated.err;
  EXPECT_THAT(understated.err, HasSubstr("6 of 6 channels of shots are noisier than stated"));
}

}  // namespace
}  // namespace scattermeter::apps
