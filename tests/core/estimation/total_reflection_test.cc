#include "core/estimation/total_reflection.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "tests/fixtures/core/boxes.h"
#include "tests/fixtures/core/dipole_cube.h"
#include "tests/fixtures/core/traced_image.h"

namespace scattermeter {
namespace {

// The front of a steep pyramid, seen from above. The camera's ray meets the base at 42.9 degrees;
// the angle of total reflection is 42.2 degrees for an index of 1.49 and 44.4 for 1.43, where the
// ray meets the base at 41.8 degrees and a fifth of the light is sent back.
TEST(TotalReflection, BendsTheLightAboveTheBaseOfAPyramid) {
  const RayScene pyramid(test_support::make_pyramid(10.0, 20.0));
  const Eigen::Vector3d normal = Eigen::Vector3d(0, -2, 1).normalized();
  const Eigen::Vector3d to_camera = Eigen::Vector3d(0, -92, 148).normalized();
  const auto bend = [&](double height_mm, double eta, double std, double mean_free_path_mm) {
    return bend_of_inner_reflection(pyramid, {0, -10.0 + height_mm / 2.0, height_mm}, normal,
                                    to_camera, {eta, std}, mean_free_path_mm);
  };
  constexpr double kDown = 0.733;  // of the ray's direction inside
  EXPECT_NEAR(bend(1.0, 1.49, 0.03, 2.0), 0.8 * std::exp(-0.5 / kDown), 0.05);
  EXPECT_NEAR(bend(3.0, 1.49, 0.03, 2.0) / bend(1.0, 1.49, 0.03, 2.0), std::exp(-1.0 / kDown),
              1e-3);
  EXPECT_LT(bend(1.0, 1.49, 0.002, 2.0), 1e-9);  // total for any index of these
  EXPECT_EQ(bend(1.0, 1.49, 0.0, 2.0), 0.0);
  EXPECT_EQ(bend(8.0, 1.49, 0.03, 1.0), 0.0);  // out of reach
  // By hand: far below the angle of total reflection, the paths' straight line serves.
  EXPECT_LT(bend(1.0, 1.3, 0.01, 2.0), 0.02);
  EXPECT_EQ(
      bend_of_inner_reflection(pyramid, {0, -9.5, 1.0}, normal, -to_camera, {1.49, 0.03}, 2.0),
      0.0);
}

// A cube of index 1.25, seen at 45 degrees: the camera's rays through its front meet the base
// beyond the angle of total reflection, as with 1.31; with 1.19 they meet it below that angle, and
// the rows above the base become darker.
TEST(TotalReflection, RowsAboveTheBaseOfACube) {
  test_support::DipoleCube cube(1, 2.5);
  const Medium medium{0.9, 0.01, 1.25};
  SceneObject& object = cube.scene.objects.front();
  object.eta_int_over_ext = medium.eta_int_over_ext;
  cube.show(medium);
  const MaterialChannel channel = material_channels(cube.scene, cube.shots, "R").front();
  const ChannelRows rows = channel_rows(cube.scene, channel);
  const double mean_free_path_mm = 1.0 / medium.sigma_t_prime_per_mm();
  object.eta_std = 0.0;
  EXPECT_TRUE(near_total_reflection(cube.scene, channel, rows, mean_free_path_mm).empty());
  object.eta_std = 0.03;
  const std::vector<Eigen::Index> numbers =
      near_total_reflection(cube.scene, channel, rows, mean_free_path_mm);

  const SeenObject& seen = *cube.shots[0].seen;
  const auto paths = [&](double eta, std::uint64_t seed) {
    Medium other = medium;
    other.eta_int_over_ext = eta;
    return test_support::traced_image(seen, cube.scene.lights[0].led()->led,
                                      scattering_medium(other), {}, seed, 100)
        .l;
  };
  // Light of the front at another index over that at the stated one: of rows near total reflection
  // over that of the others.
  const Eigen::VectorXd nominal = paths(1.25, 1);
  const auto darkening = [&](const Eigen::VectorXd& other) {
    double light[2][2] = {};
    Eigen::Index at = 0;
    for_used_rows(rows, [&](std::size_t, std::size_t j) {
      const bool near = std::binary_search(numbers.begin(), numbers.end(), at++);
      if (seen.patches->normal(seen.map.patch_of_row[j]).y() > -0.9) return;
      EXPECT_EQ(near, seen.sites[j].center_mm.z() < 3.0);
      light[near ? 1 : 0][0] += nominal[static_cast<Eigen::Index>(j)];
      light[near ? 1 : 0][1] += other[static_cast<Eigen::Index>(j)];
    });
    return light[1][1] / light[1][0] / (light[0][1] / light[0][0]);
  };
  EXPECT_LT(darkening(paths(1.19, 2)), 0.975);
  EXPECT_NEAR(darkening(paths(1.31, 3)), 1.0, 0.015);
}

}  // namespace
}  // namespace scattermeter
