#include "capture/raw/tone_curve.h"

#include <cmath>

#include <gtest/gtest.h>

namespace scattermeter::capture {
namespace {

TEST(NefLossyCurve, HasTheSizeAndTheEndsOfACompressedNef) {
  const std::vector<std::uint16_t> curve = nef_lossy_curve();
  ASSERT_EQ(curve.size(), 683U);
  EXPECT_EQ(curve.front(), 0);
  EXPECT_EQ(curve.back(), 3880);
  for (std::size_t code = 1; code < curve.size(); ++code) {
    EXPECT_GT(curve[code], curve[code - 1]) << code;
  }
}

TEST(NefLossyCurve, StepsAreOneInTheShadowsAndGrowAsTheRoot) {
  const std::vector<std::uint16_t> curve = nef_lossy_curve();
  for (std::size_t code = 0; code <= 32; ++code) EXPECT_EQ(curve[code], code);
  // step / sqrt(value) over windows of 40 codes: the same everywhere within the rounding of the two
  // ends, one count in a window of at least 40.
  const double at_top = (curve[680] - curve[640]) / 40.0 / std::sqrt(curve[660]);
  for (std::size_t code = 80; code < 640; code += 40) {
    const double here = (curve[code + 20] - curve[code - 20]) / 40.0 / std::sqrt(curve[code]);
    EXPECT_NEAR(here / at_top, 1.0, 1.0 / 40) << code;
  }
}

TEST(NearestCode, IsTheNearestAndTheLowerOnATie) {
  const std::vector<std::uint16_t> curve = {0, 10, 20, 40};
  EXPECT_EQ(nearest_code(curve, -3), 0);
  EXPECT_EQ(nearest_code(curve, 0), 0);
  EXPECT_EQ(nearest_code(curve, 5), 0);
  EXPECT_EQ(nearest_code(curve, 5.01), 1);
  EXPECT_EQ(nearest_code(curve, 20), 2);
  EXPECT_EQ(nearest_code(curve, 30), 2);
  EXPECT_EQ(nearest_code(curve, 31), 3);
  EXPECT_EQ(nearest_code(curve, 4000), 3);
}

TEST(NearestCode, EveryLevelOfTheNefCurveFindsItself) {
  const std::vector<std::uint16_t> curve = nef_lossy_curve();
  for (std::size_t code = 0; code < curve.size(); ++code) {
    EXPECT_EQ(nearest_code(curve, curve[code]), code);
  }
}

}  // namespace
}  // namespace scattermeter::capture
