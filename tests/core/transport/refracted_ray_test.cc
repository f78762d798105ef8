#include "core/transport/refracted_ray.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace scattermeter {
namespace {

// Snell at the passage, and the spread by finite differences: rays through two places of the plane
// that lie close together, radially and around the foot.
TEST(RefractedRay, FollowsSnell) {
  for (double eta : {1.0, 1.3, 1.7}) {
    for (double height_mm : {0.5, 30.0, 4000.0}) {
      for (double depth_mm : {0.0, 0.01, 2.0, 60.0}) {
        for (double foot_mm : {0.0, 1e-3, 1.0, 40.0, 3000.0}) {
          const RefractedRay ray = refracted_ray(height_mm, depth_mm, foot_mm, eta);
          const double r = ray.radius_mm;
          const double sin_outside = r / std::hypot(r, height_mm);
          const double sin_inside = (foot_mm - r) / std::max(1e-300, ray.length_mm);
          if (depth_mm > 0.0) {
            EXPECT_NEAR(sin_outside, eta * sin_inside, 1e-7);
          } else {
            EXPECT_NEAR(r, foot_mm, 1e-9);
          }
          EXPECT_NEAR(ray.length_mm * ray.cos_inside, depth_mm, 1e-12);
          const auto reached_mm = [&](double radius) {
            const double s = radius / std::hypot(radius, height_mm) / eta;
            return radius + depth_mm * s / std::sqrt(1.0 - s * s);
          };
          if (foot_mm == 0.0) continue;
          const double step = 1e-4 * r;
          const double radial = (reached_mm(r + step) - reached_mm(r - step)) / (2.0 * step);
          EXPECT_NEAR(ray.spread, radial * foot_mm / r, 1e-6 * ray.spread);
        }
      }
    }
  }
}

}  // namespace
}  // namespace scattermeter
