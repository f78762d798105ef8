#include "apps/checking/check_item.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace scattermeter::apps {
namespace {

CheckDetail detail(const std::string& where, double value,
                   double std = std::numeric_limits<double>::quiet_NaN()) {
  CheckDetail d;
  d.where = where;
  d.value = value;
  d.std = std;
  return d;
}

TEST(CheckItem, TellsRmsAndTheWorstWithItsPlace) {
  const CheckItem item = judged("pose", "px", {1.0}, "do", {detail("a", 0.3), detail("b", -0.4)});
  EXPECT_TRUE(item.passed);
  EXPECT_DOUBLE_EQ(item.worst, -0.4);
  EXPECT_EQ(item.where, "b");
  EXPECT_NEAR(item.rms, std::sqrt(0.125), 1e-15);
}

TEST(CheckItem, FailsBeyondTheLimitOnEitherSide) {
  EXPECT_FALSE(judged("x", "", {1.0}, "", {detail("a", -1.1)}).passed);
  EXPECT_TRUE(judged("x", "", {1.0}, "", {detail("a", 1.0)}).passed);
  const CheckItem low = judged("snr", "", {30.0, true}, "", {detail("a", 80), detail("b", 12)});
  EXPECT_FALSE(low.passed);
  EXPECT_EQ(low.where, "b");
}

TEST(CheckItem, AboveOnly) {
  const CheckItem item =
      judged("noise", "%", {30.0, false, true}, "", {detail("a", -90.0), detail("b", 4.0)});
  EXPECT_TRUE(item.passed);
  EXPECT_EQ(item.where, "b");
}

// A value that is only noise does not fail, however large, and the one that does is named before
// it.
TEST(CheckItem, ValuesWithinTheirDeviationsPass) {
  const CheckLimit limit{5.0, false, false, 4.0};
  EXPECT_TRUE(judged("x", "%", limit, "", {detail("noisy", 20.0, 10.0)}).passed);
  const CheckItem item =
      judged("x", "%", limit, "", {detail("noisy", 20.0, 10.0), detail("sure", 6.0, 0.1)});
  EXPECT_FALSE(item.passed);
  EXPECT_EQ(item.where, "sure");
  // Without a deviation, or with an infinite one, the value itself decides or nothing is known.
  EXPECT_TRUE(
      judged("x", "%", limit, "", {detail("a", 9.0, std::numeric_limits<double>::infinity())})
          .passed);
}

TEST(CheckItem, NoNumberFailsAndNothingPasses) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const CheckItem item = judged("x", "", {1.0}, "", {detail("a", 0.5), detail("b", nan)});
  EXPECT_FALSE(item.passed);
  EXPECT_EQ(item.where, "b");
  const CheckItem none = judged("x", "", {1.0}, "", {});
  EXPECT_TRUE(none.passed);
  EXPECT_TRUE(std::isnan(none.worst));
}

}  // namespace
}  // namespace scattermeter::apps
