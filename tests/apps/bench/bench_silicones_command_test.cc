#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/apps/small_rig.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

// Too few paths to answer anything: refused answers are told as such.
TEST(BenchSiliconesCommand, PrintsAndWritesItsTables) {
  SmallRig files;
  const Answer r = run({"bench", "--image-width", "240", "--out", files.out(), "silicones",
                        "--body", "cube", "--silicone", "white", "--images", "1",
                        "--rendered-paths", "10000", "--measured-paths", "300000"});
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.out, HasSubstr("true sigma_s'"));
  EXPECT_THAT(r.out, HasSubstr("5 to 10 %"));
  EXPECT_THAT(slurp(files.out() + "/silicones.csv"), HasSubstr("cube,1,white,0,R,"));
}

TEST(BenchSiliconesCommand, RefusesWhatDoesNotExist) {
  const Answer body = run({"bench", "silicones", "--body", "teapot"});
  EXPECT_EQ(body.status, 2);
  EXPECT_THAT(body.err, HasSubstr("bust"));
  EXPECT_EQ(run({"bench", "silicones", "--images", "4"}).status, 2);
  EXPECT_EQ(run({"bench", "silicones", "--silicone", "blue"}).status, 2);
}

}  // namespace
}  // namespace scattermeter::apps
