#include "core/scene/surroundings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/input_error.h"
#include "tests/fixtures/core/cube_scene.h"

namespace scattermeter {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

Scene scene_above(double z_mm, PlaneContact contact = PlaneContact::kAir) {
  Scene scene = test_support::cube_scene();
  ScenePlane& plane = scene.surroundings.plane.emplace();
  plane.z_mm = z_mm;
  plane.albedo = {0.1, 0.2, 0.3};
  plane.contact = contact;
  plane.line = 9;
  return scene;
}

TEST(Surroundings, WithoutAPlaneThereIsABlackStand) {
  const Scene none = test_support::cube_scene();
  const ScenePlane stand = plane_below(none, test_support::cube_objects(none).at("cube"));
  EXPECT_EQ(stand.z_mm, 0.0);
  EXPECT_TRUE((stand.albedo == 0.04).all());
  EXPECT_TRUE((stand.albedo_std == 0.04).all());
  EXPECT_EQ(stand.contact, PlaneContact::kAir);
  const Scene stated = scene_above(-3.0);
  const ScenePlane plane = plane_below(stated, test_support::cube_objects(stated).at("cube"));
  EXPECT_EQ(plane.z_mm, -3.0);
  EXPECT_EQ(plane.albedo[1], 0.2);
}

TEST(Surroundings, PlaneLiesBelowEverything) {
  const auto check = [](const Scene& scene) {
    require_above_plane(scene, test_support::cube_objects(scene));
  };
  EXPECT_NO_THROW(check(test_support::cube_scene()));
  EXPECT_NO_THROW(check(scene_above(0.0)));
  EXPECT_NO_THROW(check(scene_above(-5.0)));
  EXPECT_NO_THROW(check(scene_above(0.001, PlaneContact::kOptical)));
  EXPECT_THAT([&] { check(scene_above(0.1)); },
              ThrowsMessage<InputError>(HasSubstr("rig.yaml:9: surroundings.plane.z_mm")));
  EXPECT_THAT([&] { check(scene_above(-0.1, PlaneContact::kBlack)); },
              ThrowsMessage<InputError>(HasSubstr("surroundings.contact: no face of object cube")));
  Scene low = scene_above(-5.0);
  low.lights[0].led()->led.position_mm = {60, 0, -6};
  EXPECT_THAT([&] { check(low); },
              ThrowsMessage<InputError>(HasSubstr("rig.yaml:5: lights.led.position_mm")));
}

TEST(Surroundings, CameraLooksFromAbove) {
  const Scene scene = scene_above(-5.0);
  const ObjectScenes objects = test_support::cube_objects(scene);
  const CameraView below{scene.camera.intrinsics, look_at({0, -120, -10}, {0, 0, 10}, {0, 0, 1})};
  EXPECT_THAT([&] { require_in_view(scene, objects, below, "cube"); },
              ThrowsMessage<InputError>(HasSubstr("rig.yaml:9: surroundings.plane.z_mm")));
}

// An LED's light comes by way of the plane as well.
TEST(Surroundings, PlaneAddsLight) {
  const Scene scene = scene_above(-5.0);
  const ObjectScenes objects = test_support::cube_objects(scene);
  const auto power = [&](const DiffusePlane& plane) {
    const auto source = entry_above(scene.lights[0], *objects.at("cube").rays, 1.3, 0, plane);
    RandomStream random(1, 0);
    double sum = 0.0;
    for (int i = 0; i < 2000; ++i) {
      if (const auto entry = source->sample((i + 0.5) / 2000, random)) sum += entry->power;
    }
    return sum / 2000;
  };
  EXPECT_GT(power({0.0, 0.5}), 1.05 * power({0.0, 0.0}));
}

}  // namespace
}  // namespace scattermeter
