#include "core/light/plane_light.h"

#include <gtest/gtest.h>

#include "tests/fixtures/core/block_mean.h"
#include "tests/fixtures/core/boxes.h"
#include "tests/fixtures/core/total_power.h"

namespace scattermeter {
namespace {

Led lamp() {
  Led led;
  led.position_mm = {30, -40, 60};
  led.axis = -led.position_mm.normalized();
  led.intensity_W_per_sr = {1.0, 2.0, 4.0};
  return led;
}

TEST(PlaneLight, PowerIsIntensityTimesAlbedo) {
  const PlaneLight light(lamp(), 0.0, {0.1, 0.2, 0.3}, {0.04, 0.0, 0.02});
  EXPECT_TRUE(light.power().isApprox(Eigen::Array3d(0.1, 0.4, 1.2)));
  EXPECT_TRUE(light.is_fitted());
  EXPECT_TRUE(light.nuisances("led by the plane", 1).empty());
  const auto errors = light.nuisances("led by the plane", 2);
  ASSERT_EQ(errors.size(), 1U);
  EXPECT_EQ(errors[0].group, "surroundings");
  EXPECT_EQ(errors[0].std, 0.02);
  EXPECT_EQ(errors[0].of_unit_power, 4.0);
  EXPECT_EQ(errors[0].of_power, 0.0);
}

// Both forms of the light are per unit of the same power.
TEST(PlaneLight, SourceAndPatchesAgree) {
  const TriangleMesh box = test_support::make_box({-5, -5, 0}, {5, 5, 8});
  const RayScene scene(box);
  const PlaneLight light(lamp(), -1.0, Eigen::Array3d::Constant(0.1), Eigen::Array3d::Zero());
  const auto source = light.entry(scene, 1.4, 0);
  test_support::BlockMean drawn;
  for (int b = 0; b < 20; ++b) {
    RandomStream random(9, static_cast<std::uint64_t>(b));
    double sum = 0.0;
    for (int i = 0; i < 5000; ++i) {
      if (const auto entry = source->sample((i + random.uniform()) / 5000, random)) {
        sum += entry->power / 5000;
      }
    }
    drawn.add(sum);
  }
  for (const LightUse use : {LightUse::kMeasure, LightUse::kRender}) {
    const PatchMesh patches(box, 10.0 / *light.patches_across(use));
    const double all = test_support::total(light.illuminate(patches, scene, 1.4, use)[0]);
    EXPECT_NEAR(all, drawn.mean(), 0.01 * all + test_support::kSigmas * drawn.std_error());
  }
}

}  // namespace
}  // namespace scattermeter
