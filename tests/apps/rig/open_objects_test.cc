#include "apps/rig/open_objects.h"

#include <cmath>
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/input_error.h"
#include "core/mesh/bodies.h"
#include "tests/fixtures/apps/small_rig.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

class OpenObjects : public ::testing::Test {
 protected:
  OpenObjects() { files_.keep_shots("PE_cube"); }
  // What opening says with these meshes; "" where it opens.
  static std::string refused(const Rig& rig, const TriangleMesh& mesh) {
    try {
      open_objects(rig, [&](const SceneObject&) { return mesh; });
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  }
  SmallRig files_;
};

// The pyramid is in the rig, but no shot shows it.
TEST_F(OpenObjects, ThoseThatAShotShows) {
  const Rig rig = read_rig(files_.rig());
  const ObjectScenes objects = open_objects(rig);
  ASSERT_EQ(objects.size(), 1U);
  const ObjectScene& cube = objects.at("cube");
  EXPECT_EQ(cube.stated, &rig.scene.object("cube"));
  EXPECT_EQ(cube.size_mm(), 20.0);
  EXPECT_NEAR(cube.diagonal_mm(), 20.0 * std::sqrt(3.0), 1e-12);
  EXPECT_NEAR(signed_volume_mm3(cube.mesh()), 8000.0, 1e-9);
}

TEST_F(OpenObjects, EachMeshIsAskedForOnce) {
  const SmallRig all;
  const Rig rig = read_rig(all.rig());
  std::vector<std::string> asked;
  const ObjectScenes objects = open_objects(rig, [&](const SceneObject& object) {
    asked.push_back(object.name);
    return object.name == "cube" ? cube_mesh() : pyramid_on_pedestal_mesh();
  });
  EXPECT_EQ(asked, (std::vector<std::string>{"cube", "pyramid"}));
  EXPECT_EQ(objects.at("pyramid").stated->name, "pyramid");
}

TEST_F(OpenObjects, NamesLineAndMesh) {
  const Rig rig = read_rig(files_.rig());
  TriangleMesh open = cube_mesh();
  open.triangles.pop_back();
  EXPECT_EQ(refused(rig, cube_mesh()), "");
  const std::string of_cube = rig.at(rig.scene.object("cube").line) + ": objects.cube.mesh: ";
  EXPECT_THAT(refused(rig, open), HasSubstr(of_cube));
  EXPECT_THAT(refused(rig, open), HasSubstr("open"));
  TriangleMesh inside_out = cube_mesh();
  for (auto& triangle : inside_out.triangles) std::swap(triangle[0], triangle[1]);
  EXPECT_THAT(refused(rig, inside_out), HasSubstr(of_cube));
  std::filesystem::remove(files_ / "cube.obj");
  try {
    open_objects(rig);
    ADD_FAILURE() << "opened a mesh that is not there";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr(of_cube + files_ / "cube.obj"));
  }
}

TEST_F(OpenObjects, LimitsTheTriangles) {
  Rig rig = read_rig(files_.rig());
  rig.limits.mesh_triangles = 12;
  EXPECT_NO_THROW(open_objects(rig));
  rig.limits.mesh_triangles = 11;
  EXPECT_THROW(open_objects(rig), InputError);
}

TEST_F(OpenObjects, AnLedStandsOutside) {
  Rig rig = read_rig(files_.rig());
  rig.scene.lights[1].led()->led.position_mm = {0, 0, 20.001};
  EXPECT_EQ(refused(rig, cube_mesh()), "");
  rig.scene.lights[1].led()->led.position_mm = {0, 0, 19.9};
  EXPECT_THAT(
      refused(rig, cube_mesh()),
      HasSubstr("lights.led2.position_mm: the LED at [0, 0, 19.9] lies inside object cube"));
}

}  // namespace
}  // namespace scattermeter::apps
