#include "core/camera_connection.h"

#include <stdexcept>

#include <gtest/gtest.h>

#include "core/path_blocks.h"
#include "tests/core/block_mean.h"
#include "tests/core/boxes.h"
#include "tests/core/spheres.h"

namespace scattermeter {
namespace {

// Snell at the passage, and the spread by finite differences: rays through two places of the plane
// that lie close together, radially and around the foot.
TEST(CameraConnection, RefractsAfterSnell) {
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

struct FirstScatterings {
  double middle = 0;
  void escape(const PathScore&) {}
  void camera(const PathScore& s) {
    if (s.scatterings != 1 || s.point_mm.z() < -1e-9) return;
    if (std::abs(s.point_mm.x()) < 4.0 && std::abs(s.point_mm.y()) < 4.0) middle += s.weight;
  }
};

// Light scattered once, of an even beam straight down: with E the irradiance behind the surface,
//   l(P) = pi / eta^2 ∫ exp(-sigma_t s) sigma_s p E exp(-sigma_t s cos) ds
//        = pi / eta^2 sigma_s p E / (sigma_t (1 + cos)),
// cos that of the refracted ray from P to the camera; over the middle of the face by a midpoint
// rule.
TEST(CameraConnection, SeesSingleScatteringAsQuadratureDoes) {
  const RayScene scene(testing::make_box({-12, -12, -12}, {12, 12, 0}));
  const PathBoundary boundary(scene);
  const ScatteringMedium medium{1.5, 0.5, 0.4, 1.3};
  const auto source = beam_entry({{-10, -10, 0}, {20, 0, 0}, {0, 20, 0}, {0, 0, -1}});
  for (const Eigen::Vector3d& eye : {Eigen::Vector3d(3, -8, 10), Eigen::Vector3d(0, -800, 400)}) {
    const CameraConnection camera(boundary, eye, medium);
    testing::BlockMean seen;
    PathOptions options;
    options.paths_per_block = 2000;
    trace_blocks<FirstScatterings>(
        {boundary, medium, *source, &camera}, options, 0, 60, [] { return FirstScatterings(); },
        [&](const FirstScatterings& s, const PathAudit&) { seen.add(s.middle); });
    double expected = 0.0;
    constexpr int kSteps = 200;
    for (int i = 0; i < kSteps; ++i) {
      for (int j = 0; j < kSteps; ++j) {
        const Eigen::Vector3d p(-4.0 + (i + 0.5) * 8.0 / kSteps, -4.0 + (j + 0.5) * 8.0 / kSteps,
                                0);
        const double cos_out = (eye - p).normalized().z();
        const double cosine = std::sqrt(1.0 - (1.0 - cos_out * cos_out) / (1.3 * 1.3));
        expected += std::numbers::pi / (1.3 * 1.3) * 1.5 * HenyeyGreenstein(0.4).per_sr(-cosine) /
                    400.0 / (2.0 * (1.0 + cosine)) * std::pow(8.0 / kSteps, 2);
      }
    }
    EXPECT_LT(std::abs(seen.z(expected)), testing::kSigmas) << seen.mean() << " " << expected;
    EXPECT_LT(seen.std_error(), 0.015 * expected);
  }
}

TEST(CameraConnection, RefusesManyPlanes) {
  const RayScene scene(testing::make_sphere(10, 2));
  const PathBoundary boundary(scene);
  EXPECT_THROW(CameraConnection(boundary, {0, 0, 50}, ScatteringMedium{}), std::invalid_argument);
}

}  // namespace
}  // namespace scattermeter
