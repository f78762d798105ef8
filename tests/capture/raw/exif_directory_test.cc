#include "capture/raw/exif_directory.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scattermeter::capture {
namespace {

TEST(NearestRational, IsTheSimplestThatTellsTheValue) {
  struct Case {
    double value;
    Rational expected;
  };
  for (const Case& c : {Case{0.1, {1, 10}}, Case{1.0 / 3, {1, 3}}, Case{1.0 / 8000, {1, 8000}},
                        Case{30, {30, 1}}, Case{5.6, {28, 5}}, Case{123.456, {15432, 125}},
                        Case{4294967295.0, {4294967295U, 1}}, Case{3.0e-10, {1, 3333333333U}}}) {
    const Rational rational = nearest_rational(c.value);
    EXPECT_EQ(rational.numerator, c.expected.numerator) << c.value;
    EXPECT_EQ(rational.denominator, c.expected.denominator) << c.value;
  }
}

// A convergent n/d is nearer to v than 1 / (d d'), where n'/d' is the next one. That did not fit in
// 32 bits: d' is at least 2^32, or n' is and d' at least 2^32 / v (but for rounding).
TEST(NearestRational, IsAsNearAs32BitsAllow) {
  std::mt19937_64 generator(3);
  std::uniform_real_distribution<double> exponent(-4, 4);
  for (int i = 0; i < 10000; ++i) {
    const double value = std::pow(10.0, exponent(generator));
    const Rational rational = nearest_rational(value);
    const double d = rational.denominator;
    const double bound = 1.001 * std::max(1.0, value) / (d * 4294967296.0) + 1e-15 * value;
    EXPECT_NEAR(rational.numerator / d, value, bound);
  }
}

TEST(NearestRational, RefusesWhatHasNone) {
  for (const double bad : {0.0, -1.0, 1e-11, 5e9, std::numeric_limits<double>::infinity(),
                           std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW(nearest_rational(bad), std::invalid_argument) << bad;
  }
}

TEST(ExifDirectory, StandsAtItsOffset) {
  EXPECT_THAT(exif_directory(8, 0.1, 5.6, 400),
              testing::ElementsAre(3, 0,                                         // entries
                                   0x9a, 0x82, 5, 0, 1, 0, 0, 0, 50, 0, 0, 0,    // at 8 + 42
                                   0x9d, 0x82, 5, 0, 1, 0, 0, 0, 58, 0, 0, 0,    // at 8 + 50
                                   0x27, 0x88, 3, 0, 1, 0, 0, 0, 0x90, 1, 0, 0,  // 400
                                   0, 0, 0, 0,                                   // no next
                                   1, 0, 0, 0, 10, 0, 0, 0, 28, 0, 0, 0, 5, 0, 0, 0));
}

}  // namespace
}  // namespace scattermeter::capture
