#include "capture/sensor/radiance_calibration.h"

#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

namespace scattermeter::capture {
namespace {

TEST(RadiancePoints, AreMeansOfHalfOctaves) {
  // 100 and 110 share half an octave, 200 is alone.
  const std::vector<RadiancePoint> points =
      radiance_points({100, 110, 100, 110, 200, -5}, {1, 3, 1, 3, 9, 9}, 2);
  ASSERT_EQ(points.size(), 1U);
  EXPECT_DOUBLE_EQ(points[0].counts, 105);
  EXPECT_DOUBLE_EQ(points[0].value, 2);
  EXPECT_NEAR(points[0].std, std::sqrt(4.0 / 3.0 / 4.0), 1e-12);
  EXPECT_THROW(radiance_points({1}, {}), std::invalid_argument);
}

}  // namespace
}  // namespace scattermeter::capture
