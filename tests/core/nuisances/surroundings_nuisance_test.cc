#include "core/nuisances/surroundings_nuisance.h"

#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

#include "core/estimation/channel_weights.h"
#include "tests/fixtures/core/dipole_cube.h"
#include "tests/fixtures/core/traced_image.h"

namespace scattermeter {
namespace {

constexpr int kGroups = 4;

// The lit front of the cube in three heights, from below, and its top.
int group_of(const SeenObject& seen, std::size_t row) {
  const int patch = seen.map.patch_of_row[row];
  if (seen.patches->normal(patch).z() > 0.5) return 3;
  return std::min(2, static_cast<int>(seen.patches->center_mm(patch).z() / 20.0 * 3.0));
}

std::array<double, kGroups> means(const SeenObject& seen, const Eigen::VectorXd& l) {
  std::array<double, kGroups> sum{};
  for (std::size_t j = 0; j < seen.sites.size(); ++j) {
    sum[static_cast<std::size_t>(group_of(seen, j))] +=
        l[static_cast<Eigen::Index>(j)] * seen.patches->area_mm2(seen.map.patch_of_row[j]);
  }
  return sum;
}

// l by paths, a mean over the groups' rows.
std::array<double, kGroups> traced(const SeenObject& seen, const Led& led, const Medium& medium,
                                   const std::optional<DiffusePlane>& plane, int blocks) {
  return means(
      seen, test_support::traced_image(seen, led, scattering_medium(medium), plane, 1, blocks).l);
}

// Change per unit of albedo, relative to the image without the plane, in each group: paths in the
// plane's presence against the column. On the plane, and hanging above it.
// Where the mean free path is a twentieth of the cube the dipole itself is off by a fifth near
// edges and behind the body.
TEST(SurroundingsNuisance, MeetsPathsAboveAPlane) {
  test_support::DipoleCube cube;
  cube.scene.objects[0].eta_int_over_ext = 1.4;
  const SeenObject& seen = *cube.shots[0].seen;
  const Led& led = cube.scene.lights[0].led()->led;
  add_smooth_weights(cube.scene, cube.shots, cube.lit, nullptr, cube.weights);
  const DistanceKnots knots = smooth_knots(cube.lit);
  const IncidentLight& direct = cube.lit.light("cube", "led", 0);
  for (const Medium& medium : {Medium{1.0, 0.01, 1.4}, Medium{4.0, 0.06, 1.4}}) {
    const std::vector<LitMedium> media = {{medium, 1.0}, {medium, 2.0}};
    const auto dipole =
        means(seen, cube.weights.at({&seen, "led", 0}) * scaled_curves(media, knots, 1.4).col(0));
    const auto none = traced(seen, led, medium, std::nullopt, 50);
    for (const double z_mm : {0.0, -8.0}) {
      ScenePlane plane;
      plane.z_mm = z_mm;
      plane.albedo.setConstant(0.25);
      const Eigen::MatrixXd change = change_by_plane(seen, led, direct, plane, knots, media);
      EXPECT_LT((change.col(1) - 2.0 * change.col(0)).norm(), 1e-9 * change.norm());
      const auto column = means(seen, change.col(0));
      const auto with_plane = traced(seen, led, medium, plane.in(0), 50);
      for (std::size_t g = 0; g < kGroups; ++g) {
        const double expected = (with_plane[g] / none[g] - 1.0) / 0.25;
        const double allowed = medium.sigma_s_prime_per_mm > 2.0 ? 0.1 : 0.25;
        EXPECT_NEAR(column[g] / dipole[g], expected, allowed * expected + 0.03)
            << medium.sigma_s_prime_per_mm << ", " << z_mm << ", group " << g;
      }
    }
  }
}

}  // namespace
}  // namespace scattermeter
