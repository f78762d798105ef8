#include "core/scene/object_scene.h"

#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/input_error.h"
#include "tests/fixtures/core/cube_scene.h"

namespace scattermeter {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

TEST(ObjectScene, KnowsItsSize) {
  const Scene scene = test_support::cube_scene();
  const ObjectScene object = object_scene(scene, scene.objects[0], cube_mesh());
  EXPECT_EQ(object.stated, &scene.objects[0]);
  EXPECT_DOUBLE_EQ(object.size_mm(), 20.0);
  EXPECT_FALSE(object.is_round);
  EXPECT_DOUBLE_EQ(object.diagonal_mm(), 20.0 * std::sqrt(3.0));
}

TEST(ObjectScene, StandsWhereItIsStated) {
  Scene scene = test_support::cube_scene();
  scene.objects[0].world_from_mesh = {
      Eigen::Quaterniond(Eigen::AngleAxisd(0.5 * std::numbers::pi, Eigen::Vector3d::UnitX())),
      {1, 2, 3}};
  const ObjectScene object = object_scene(scene, scene.objects[0], cube_mesh());
  // The cube stands on z = 0 in its mesh; its z becomes -y.
  EXPECT_LT((object.box.min_mm - Eigen::Vector3d(-9, -18, -7)).norm(), 1e-12);
  EXPECT_LT((object.box.max_mm - Eigen::Vector3d(11, 2, 13)).norm(), 1e-12);
  EXPECT_FALSE(object.rays->contains({0, 0, -8}));
  EXPECT_TRUE(object.rays->contains({0, -17, 0}));
}

TEST(ObjectScene, RefusesAnOpenMesh) {
  const Scene scene = test_support::cube_scene();
  TriangleMesh open = cube_mesh();
  open.triangles.pop_back();
  EXPECT_THAT([&] { object_scene(scene, scene.objects[0], open); },
              ThrowsMessage<InputError>(HasSubstr("rig.yaml:3: objects.cube.mesh: cube.obj")));
}

TEST(ObjectScene, RefusesALightInsideTheObject) {
  Scene scene = test_support::cube_scene();
  const ObjectScenes objects = test_support::cube_objects(scene);
  EXPECT_NO_THROW(require_lights_outside(scene, objects));
  scene.lights[0].led()->led.position_mm = {0, 0, 10};
  EXPECT_THAT([&] { require_lights_outside(scene, objects); },
              ThrowsMessage<InputError>(HasSubstr("rig.yaml:5: lights.led.position_mm")));
}

TEST(ObjectScene, RefusesAnObjectThatTheCameraDoesNotSee) {
  const Scene scene = test_support::cube_scene();
  const ObjectScenes objects = test_support::cube_objects(scene);
  const auto from = [&](const Eigen::Vector3d& position_mm, const Eigen::Vector3d& target_mm) {
    return [&scene, &objects, position_mm, target_mm] {
      require_in_view(scene, objects,
                      {scene.camera.intrinsics, look_at(position_mm, target_mm, {0, 0, 1})},
                      "cube");
    };
  };
  EXPECT_NO_THROW(from({0, -120, 120}, {0, 0, 10})());
  EXPECT_THAT(from({0, -120, 120}, {0, -240, 230}),
              ThrowsMessage<InputError>(HasSubstr("lies behind")));
  EXPECT_THAT(from({0, -120, 120}, {200, 0, 10}),
              ThrowsMessage<InputError>(HasSubstr("outside the frame")));
  EXPECT_THAT(from({0, 0, 10}, {0, 10, 10}), ThrowsMessage<InputError>(HasSubstr("inside")));
}

}  // namespace
}  // namespace scattermeter
