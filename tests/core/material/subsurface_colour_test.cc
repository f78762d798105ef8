#include "core/material/subsurface_colour.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace scattermeter {
namespace {

TEST(SubsurfaceColour, GoesBothWays) {
  for (const ColourFit* fit : {&openpbr_colour(), &cycles_colour()}) {
    double before = -1.0;
    for (double albedo : {0.0, 0.01, 0.1, 0.5, 0.9, 0.99, 0.999, 0.9999, 0.999998}) {
      const double colour = fit->colour_of(albedo);
      EXPECT_NEAR(fit->albedo_of(colour), albedo, 1e-12) << fit->source;
      EXPECT_GT(colour, before);
      EXPECT_LE(colour, 1.0);
      before = colour;
    }
    EXPECT_EQ(fit->colour_of(1.0), 1.0);
  }
  EXPECT_EQ(openpbr_colour().albedo_of(1.0), 1.0);
  EXPECT_EQ(cycles_colour().albedo_of(1.0), 0.999999);
}

// Halving in cycles_colour() asks for a fit that grows.
TEST(SubsurfaceColour, CyclesFitGrows) {
  double before = -1.0;
  for (int i = 0; i <= 10000; ++i) {
    const double albedo = cycles_colour().albedo_of(i / 10000.0);
    if (albedo >= 0.999999) break;
    ASSERT_GT(albedo, before) << i;
    before = albedo;
  }
}

// The specification's six figures are those of the root that is solved here.
TEST(SubsurfaceColour, OpenPbrIsTheSpecifications) {
  for (double colour : {0.0, 0.2, 0.5, 0.8, 0.99}) {
    const double s = 4.09712 + 4.20863 * colour -
                     std::sqrt(9.59217 + 41.6808 * colour + 17.7126 * colour * colour);
    EXPECT_NEAR(openpbr_colour().albedo_of(colour), 1.0 - s * s, 2e-5);
  }
}

// The errors that the header states, against the exact reflectance.
TEST(SubsurfaceColour, ErrorsAreThoseStated) {
  double openpbr = 0.0, cycles = 0.0;
  for (double albedo = 0.005; albedo < 0.9999; albedo += 0.005) {
    openpbr = std::max(openpbr, std::abs(colour_error(openpbr_colour(), albedo)));
    if (albedo <= 0.95) cycles = std::max(cycles, std::abs(colour_error(cycles_colour(), albedo)));
  }
  EXPECT_LT(openpbr, 0.0021);
  EXPECT_GT(openpbr, 0.0020);
  EXPECT_LT(cycles, 0.006);
  EXPECT_GT(cycles, 0.005);
  EXPECT_NEAR(colour_error(cycles_colour(), 0.99), -0.010, 0.0005);
  EXPECT_NEAR(colour_error(cycles_colour(), 0.999), -0.034, 0.0005);
  EXPECT_NEAR(colour_error(cycles_colour(), 0.9999), -0.062, 0.0005);
}

}  // namespace
}  // namespace scattermeter
