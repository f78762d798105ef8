#include "core/estimation/mesh_scale.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/fixtures/core/dipole_cube.h"

namespace scattermeter {
namespace {

TEST(MeshScale, CoefficientsAreAsUncertainAsLengths) {
  test_support::DipoleCube cube;
  cube.show(test_support::kCubeMedium);
  const MaterialChannel channel = material_channels(cube.scene, cube.shots, "R").front();
  Estimate exact;
  exact.sigma_s_prime_per_mm = normal_quantity(2.0, 0.003);
  exact.sigma_a_per_mm = normal_quantity(0.01, 0.0002);
  exact.correlation = -0.5;
  Estimate e = exact;
  widen_by_mesh_scale(channel, e);
  EXPECT_EQ(e.sigma_s_prime_per_mm.std, exact.sigma_s_prime_per_mm.std);
  EXPECT_TRUE(e.budget.empty());
  cube.scene.objects[0].scale_relative_std = 0.002;
  widen_by_mesh_scale(channel, e);
  EXPECT_NEAR(e.sigma_s_prime_per_mm.std, std::hypot(0.003, 0.004), 1e-15);
  EXPECT_NEAR(e.sigma_a_per_mm.std, std::hypot(0.0002, 0.00002), 1e-15);
  // Covariances add up: -0.5 * 0.003 * 0.0002 + 0.004 * 0.00002.
  EXPECT_NEAR(e.correlation * e.sigma_s_prime_per_mm.std * e.sigma_a_per_mm.std, -2.2e-7, 1e-15);
  EXPECT_NEAR(e.sigma_s_prime_per_mm.high95, 2.0 + 1.96 * 0.005, 1e-12);
  ASSERT_EQ(e.budget.size(), 1U);
  EXPECT_EQ(e.budget[0].cause, "mesh scale");
  EXPECT_NEAR(e.budget[0].std_sigma_s_prime_per_mm, 0.004, 1e-15);
}

}  // namespace
}  // namespace scattermeter
