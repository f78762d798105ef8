#include "apps/rig/rig_place_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "apps/rig/rig.h"
#include "core/base/input_error.h"
#include "tests/fixtures/apps/small_rig.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

TEST(RigPlaceReader, WhereAPieceStands) {
  SmallRig small;
  const std::string text = small.text();
  const auto cube = [&](const std::string& keys, const std::string& pose = "pose:\n") {
    small.write(replaced(replaced(text, "cube: {mesh: cube.obj, eta: 1.4}",
                                  "cube: {mesh: cube.obj, eta: 1.4, " + keys + "}"),
                         "pose:\n", pose));
    return read_rig(small.rig()).scene.object("cube");
  };
  const SceneObject stated = cube("pose: {position_mm: [1, 2, 3], turn_deg: [90, 0, 90]}");
  EXPECT_FALSE(stated.to_be_found.has_value());
  // About x first: y becomes z; then about z.
  EXPECT_LT((stated.world_from_mesh * Eigen::Vector3d(1, 1, 0) - Eigen::Vector3d(1, 3, 4)).norm(),
            1e-12);
  EXPECT_FALSE(cube("pose: {from: silhouette}").to_be_found->is_on_plane);
  EXPECT_TRUE(cube("pose: {from: silhouette, on_plane: true}").to_be_found->is_on_plane);
  EXPECT_FALSE(cube("pose: {from: silhouette}").to_be_found->is_per_shot);
  EXPECT_THAT([&] { cube("pose: {per_shot: true}"); },
              ThrowsMessage<InputError>(HasSubstr("objects.cube.pose.per_shot")));
  EXPECT_THAT([&] { cube("pose: {from: outline}"); },
              ThrowsMessage<InputError>(HasSubstr("objects.cube.pose.from: expected stated or "
                                                  "silhouette")));
  EXPECT_THAT([&] { cube("pose: {on_plane: true}"); },
              ThrowsMessage<InputError>(HasSubstr("objects.cube.pose.on_plane")));
  EXPECT_THAT([&] { cube("pose: {from: silhouette}, position_std_mm: 0.1"); },
              ThrowsMessage<InputError>(HasSubstr("objects.cube.position_std_mm")));
  EXPECT_THAT([&] { cube("pose: {from: silhouette}", "pose:\n  refine: silhouette\n"); },
              ThrowsMessage<InputError>(HasSubstr("objects.cube.pose.from")));
}

TEST(RigPlaceReader, EachStandingIsAnObjectOfItsOwn) {
  SmallRig small;
  small.keep_shots("POM");
  small.write(replaced(small.text(), "cube: {mesh: cube.obj, eta: 1.4}",
                       "cube: {mesh: cube.obj, eta: 1.4, pose: {from: silhouette, per_shot: "
                       "true}}"));
  const Scene scene = read_rig(small.rig()).scene;
  for (const SceneShot& shot : scene.shots) {
    const bool is_cube = shot.file.find("cube") != std::string::npos;
    EXPECT_EQ(shot.object, is_cube ? "cube in " + shot.file : "pyramid");
    EXPECT_EQ(scene.object(shot.object).piece_name(), is_cube ? "cube" : "pyramid");
  }
  EXPECT_EQ(scene.objects.size(), 3U);
}

}  // namespace
}  // namespace scattermeter::apps
