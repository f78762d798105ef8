#include "apps/simulation/plastics_rig.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "apps/simulation/bodies_rig.h"
#include "apps/simulation/virtual_shots.h"
#include "capture/files/obj_reader.h"
#include "core/mesh/bodies.h"

namespace scattermeter::apps {
namespace {

// The meshes in code are the sample's.
TEST(PlasticsRig, BodiesAreTheSamples) {
  const std::string samples = std::string(SCATTERMETER_SOURCE_DIR) + "/samples/three_plastics/";
  for (const auto& [mesh, file] : {std::pair{cube_mesh(), "cube.obj"},
                                   {pyramid_on_pedestal_mesh(), "pyramid_on_pedestal.obj"}}) {
    EXPECT_EQ(mesh_problem(mesh), "");
    const TriangleMesh read = capture::read_obj(samples + file);
    EXPECT_EQ(mesh.triangles.size(), read.triangles.size());
    EXPECT_NEAR(signed_volume_mm3(mesh), signed_volume_mm3(read), 1e-9);
    EXPECT_EQ(bounds(mesh).min_mm, bounds(read).min_mm);
    EXPECT_EQ(bounds(mesh).max_mm, bounds(read).max_mm);
  }
}

TEST(PlasticsRig, RefusesOtherWidths) {
  EXPECT_THROW(plastics_rig(100), std::invalid_argument);
  const Rig rig = plastics_rig(969);
  EXPECT_EQ(rig.scene.camera.intrinsics.width_px, 968);
  EXPECT_EQ(rig.scene.camera.intrinsics.height_px % 2, 0);
  EXPECT_EQ(plastics_rig(3872).scene.camera.intrinsics.height_px, 2592);
  EXPECT_EQ(rig.scene.shots.size(), 12U);
}

// Both bodies are wholly in the frame, and the brightest of the materials clips nowhere.
TEST(PlasticsRig, ShowsAll) {
  Rig rig = plastics_rig(242);
  std::erase_if(rig.scene.shots, [](const SceneShot& shot) { return shot.material != "POM"; });
  const ObjectScenes scenes = bodies_scenes(rig);
  const VirtualShots shots(rig, scenes, {.noise = false});
  ASSERT_EQ(shots.size(), 4U);
  const int top = rig.scene.camera.sensor.white_counts - rig.scene.camera.sensor.black_counts[0];
  for (std::size_t i = 0; i < shots.size(); ++i) {
    const LinearPicture& p = shots.picture(i);
    EXPECT_GT(p.x0, 0);
    EXPECT_GT(p.y0, 0);
    EXPECT_LT(p.x0 + p.width, rig.scene.camera.intrinsics.width_px);
    EXPECT_LT(p.y0 + p.height, rig.scene.camera.intrinsics.height_px);
    // Room for the noise of the brightest sample, some 60 counts.
    EXPECT_LT(*std::max_element(p.counts.begin(), p.counts.end()), top - 240)
        << rig.scene.shots[i].file;
  }
}

}  // namespace
}  // namespace scattermeter::apps
