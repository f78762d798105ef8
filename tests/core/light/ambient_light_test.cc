#include "core/light/ambient_light.h"

#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/fixtures/core/boxes.h"
#include "tests/fixtures/core/total_power.h"

namespace scattermeter {
namespace {

// Radiance 1 from everywhere gives pi of irradiance to every facet of a convex body without a
// boundary (eta 1).
TEST(AmbientLight, PutsPiOnEverySurface) {
  const TriangleMesh cube = test_support::make_cube();
  const RayScene scene(cube);
  const AmbientLight light;
  for (const LightUse use : {LightUse::kMeasure, LightUse::kRender}) {
    const auto lit = light.illuminate(PatchMesh(cube, 4.0), scene, 1.0, use);
    ASSERT_EQ(lit.size(), light.channels());
    EXPECT_NEAR(test_support::total(lit[0]), std::numbers::pi * 6.0 * 400.0, 3.0);
  }
}

// Radiance w_k adds 2 pi / 3 n_k to the irradiance of a facet with normal n: nothing in the sum of
// a body's opposite faces, and that much on the face towards +k.
TEST(AmbientLight, MoreFromOneSide) {
  const TriangleMesh cube = test_support::make_cube();
  const RayScene scene(cube);
  const PatchMesh patches(cube, 4.0);
  const auto lit = illuminate_more_from_axes(patches, scene, 1.0);
  for (int k = 0; k < 3; ++k) {
    const IncidentLight& light = lit[static_cast<std::size_t>(k)];
    EXPECT_NEAR(test_support::total(light), std::numbers::pi * 6.0 * 400.0, 30.0);
    double towards = 0.0;
    for (int p = 0; p < patches.size(); ++p) {
      if (patches.normal(p)[k] > 0.5) towards += light.patch_power_sr[static_cast<std::size_t>(p)];
    }
    EXPECT_NEAR(towards, (1.0 + 2.0 / 3.0) * std::numbers::pi * 400.0, 15.0) << k;
  }
}

TEST(AmbientLight, IsFittedAsAnAbsoluteRadiance) {
  AmbientLight light;
  EXPECT_TRUE(light.is_fitted());
  EXPECT_TRUE(light.nuisances("hall", 0).empty());
  light.radiance_std_W_per_mm2_sr = {1e-9, std::numeric_limits<double>::infinity(), 0.0};
  const auto red = light.nuisances("hall", 0);
  ASSERT_EQ(red.size(), 1U);
  EXPECT_EQ(red[0].name, "hall.ambient");
  EXPECT_EQ(red[0].std, 1e-9);
  EXPECT_EQ(red[0].of_unit_power, 1.0);
  EXPECT_EQ(red[0].of_power, 0.0);
  EXPECT_EQ(light.nuisances("hall", 1).front().std, std::numeric_limits<double>::infinity());
  EXPECT_TRUE(light.nuisances("hall", 2).empty());
}

TEST(AmbientLight, IrradianceOfAnOpenSurface) {
  AmbientLight light;
  light.radiance_W_per_mm2_sr = {1.0, 2.0, 0.5};
  const Eigen::Array3d e = light.open_irradiance_W_per_mm2({0, 0, 1});
  EXPECT_NEAR(e[0], std::numbers::pi, 1e-3);
  EXPECT_NEAR(e[1] / e[0], 2.0, 1e-12);
}

}  // namespace
}  // namespace scattermeter
