#include "core/material/slab_reflectance.h"

#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

#include "core/material/half_space_albedo.h"

namespace scattermeter {
namespace {

constexpr double kThick_mm = 1e4;

// Without faces and background it is the half-space, for which Chandrasekhar's solution is exact.
TEST(SlabReflectance, ThickSlabWithoutFacesIsTheHalfSpace) {
  for (const double albedo : {0.9, 0.95, 0.99, 0.999, 0.9999}) {
    const Medium medium{albedo, 1.0 - albedo, 1.0};
    EXPECT_NEAR(slab_reflectance(medium, kThick_mm, 0.0), half_space_albedo(albedo), 0.013)
        << albedo;
  }
}

// By hand: L = 10, sigma_s' = 1, D = 1/3: r = 10 / (10 + 4/3) = 0.88235.
TEST(SlabReflectance, WithoutFacesAndAbsorption) {
  EXPECT_NEAR(slab_reflectance({1.0, 0.0, 1.0}, 10.0, 0.0), 30.0 / 34.0, 1e-12);
  // A grey background b under it: r + t^2 b / (1 - r b).
  const double r = 30.0 / 34.0, t = 4.0 / 34.0;
  EXPECT_NEAR(slab_reflectance({1.0, 0.0, 1.0}, 10.0, 0.5), r + t * t * 0.5 / (1.0 - 0.5 * r),
              1e-12);
}

// What absorbs nothing on a background that absorbs nothing returns all light, faces or not.
TEST(SlabReflectance, IsConservative) {
  for (const double eta : {1.0, 1.3, 1.5}) {
    for (const double thickness_mm : {0.5, 10.0, 300.0}) {
      EXPECT_NEAR(slab_reflectance({0.7, 0.0, eta}, thickness_mm, 1.0), 1.0, 1e-12);
    }
  }
}

// The limit of no absorption is met smoothly.
TEST(SlabReflectance, IsContinuousAtNoAbsorption) {
  const double without = slab_reflectance({1.0, 0.0, 1.49}, 10.0, 0.3);
  EXPECT_NEAR(slab_reflectance({1.0, 1e-13, 1.49}, 10.0, 0.3), without, 1e-9);
  EXPECT_NEAR(slab_reflectance({1.0, 1e-10, 1.49}, 10.0, 0.3), without, 1e-6);
}

TEST(SlabReflectance, Order) {
  const Medium medium{1.0, 0.002, 1.49};
  const double black = slab_reflectance(medium, 10.0, 0.0);
  const double white = slab_reflectance(medium, 10.0, 1.0);
  const double deep = slab_reflectance(medium, kThick_mm, 0.0);
  EXPECT_LT(black, white);
  EXPECT_LT(black, deep);
  EXPECT_NEAR(slab_reflectance(medium, kThick_mm, 1.0), deep, 1e-9);
  EXPECT_LT(slab_reflectance({1.0, 0.02, 1.49}, 10.0, 1.0), white);
}

TEST(SlabReflectance, RefusesWhatIsNoSlab) {
  EXPECT_THROW(slab_reflectance({0.0, 0.1, 1.3}, 10.0, 0.0), std::invalid_argument);
  EXPECT_THROW(slab_reflectance({1.0, -0.1, 1.3}, 10.0, 0.0), std::invalid_argument);
  EXPECT_THROW(slab_reflectance({1.0, 0.1, 1.3}, 0.0, 0.0), std::invalid_argument);
  EXPECT_THROW(slab_reflectance({1.0, 0.1, 1.3}, 10.0, 1.1), std::invalid_argument);
}

}  // namespace
}  // namespace scattermeter
