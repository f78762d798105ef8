#include "core/scene/lit_objects.h"

#include <cmath>
#include <optional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/input_error.h"
#include "tests/fixtures/core/cube_scene.h"

namespace scattermeter {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

TEST(LitObjects, ChoosesThePatchSize) {
  Scene scene = test_support::cube_scene();
  const ObjectScenes objects = test_support::cube_objects(scene);
  const auto size_mm = [&](std::optional<double> asked, double distance_mm) {
    return LitObjects(scene, objects, asked, distance_mm).smallest_patch_mm();
  };
  EXPECT_DOUBLE_EQ(size_mm(std::nullopt, 0.0), 20.0 / 50.0);
  EXPECT_DOUBLE_EQ(size_mm(std::nullopt, 180.0), 8.0 * 180.0 / 900.0);  // six samples and more
  scene.objects[0].patch_size_mm = 2.5;
  EXPECT_DOUBLE_EQ(size_mm(std::nullopt, 180.0), 2.5);
  EXPECT_DOUBLE_EQ(size_mm(4.0, 180.0), 4.0);
  EXPECT_THROW(size_mm(1e-5, 180.0), InputError);
  EXPECT_THAT(
      [&] { size_mm(1000.0, 180.0); },
      ThrowsMessage<InputError>(HasSubstr("objects.cube.patch_size_mm: 1000 mm is larger")));
}

TEST(LitObjects, MakesEachLightOnce) {
  const Scene scene = test_support::cube_scene();
  const ObjectScenes objects = test_support::cube_objects(scene);
  LitObjects lit(scene, objects, 4.0, 0.0);
  EXPECT_TRUE(lit.lights_so_far().empty());
  const IncidentLight& first = lit.light("cube", "led", 0);
  EXPECT_EQ(&lit.light("cube", "led", 0), &first);
  EXPECT_EQ(lit.lights_so_far().size(), 1U);
  // Another eta is another light.
  EXPECT_NE(&lit.light_on("cube", scene.lights[0], 0, lit.patches("cube"), 1.5), &first);
  EXPECT_NEAR(lit.longest_distance_mm(), 20.0 * std::sqrt(3.0), 1e-12);
}

TEST(LitObjects, RefusesAnLedThatMissesTheObject) {
  Scene scene = test_support::cube_scene();
  scene.lights[0].led()->led.axis = {0, 0, 1};
  const ObjectScenes objects = test_support::cube_objects(scene);
  LitObjects lit(scene, objects, 4.0, 0.0);
  EXPECT_THAT([&] { lit.light("cube", "led", 0); },
              ThrowsMessage<InputError>(HasSubstr("rig.yaml:5: lights.led")));
}

TEST(LitObjects, OpensTheLightsOfShotsAtOnce) {
  Scene scene = test_support::cube_scene();
  scene.lights[0].kind =
      DistantLight([]() -> Environment { throw InputError("rig.yaml:5: lights.led", "lost"); });
  const ObjectScenes objects = test_support::cube_objects(scene);
  EXPECT_THROW(LitObjects(scene, objects, 4.0, 0.0), InputError);
}

}  // namespace
}  // namespace scattermeter
