#include "core/light/distant_light.h"

#include <stdexcept>

#include <gtest/gtest.h>

#include "core/base/input_error.h"
#include "tests/fixtures/core/boxes.h"
#include "tests/fixtures/core/total_power.h"

namespace scattermeter {
namespace {

// Radiance 1 in red, 2 in green, 4 in blue from everywhere.
Environment coloured() {
  Environment out;
  out.width_px = 8;
  out.height_px = 4;
  for (int i = 0; i < 32; ++i) out.radiance.insert(out.radiance.end(), {1.0F, 2.0F, 4.0F});
  return out;
}

TEST(DistantLight, CopiesShareOneReading) {
  int readings = 0;
  const DistantLight light([&readings] {
    ++readings;
    return coloured();
  });
  const DistantLight copy = light;
  EXPECT_EQ(readings, 0);  // nothing is read before it is needed
  copy.open();
  light.open();
  EXPECT_EQ(&light.probe(), &copy.probe());
  EXPECT_EQ(readings, 1);
}

TEST(DistantLight, ReportsAPictureThatCannotBeRead) {
  const DistantLight light([]() -> Environment { throw InputError("rig.yaml:3", "no such file"); });
  EXPECT_THROW(light.open(), InputError);
  EXPECT_THROW(DistantLight().open(), std::logic_error);
}

TEST(DistantLight, HasThreeChannels) {
  const DistantLight light(coloured);
  const TriangleMesh cube = test_support::make_cube();
  const RayScene scene(cube);
  const auto lit = light.illuminate(PatchMesh(cube, 4.0), scene, 1.3, LightUse::kMeasure);
  ASSERT_EQ(lit.size(), 3U);
  const double red = test_support::total(lit[0]);
  EXPECT_NEAR(test_support::total(lit[1]) / red, 2.0, 1e-6);
  EXPECT_NEAR(test_support::total(lit[2]) / red, 4.0, 1e-6);
  EXPECT_NEAR(
      light.open_irradiance_W_per_mm2({0, 0, 1})[2] / light.open_irradiance_W_per_mm2({0, 0, 1})[0],
      4.0, 1e-6);
}

TEST(DistantLight, PowerAloneIsUncertain) {
  DistantLight light(coloured);
  EXPECT_TRUE(light.nuisances("hall", 0).empty());
  light.radiance_relative_std = 0.1;
  const auto nuisances = light.nuisances("hall", 0);
  ASSERT_EQ(nuisances.size(), 1U);
  EXPECT_EQ(nuisances[0].of_power, 1.0);
  EXPECT_EQ(nuisances[0].std, 0.1);
}

}  // namespace
}  // namespace scattermeter
