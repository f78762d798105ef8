#include "capture/shots/shot_key.h"

#include <functional>
#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "capture/sensor/radiance_calibration.h"
#include "core/base/input_error.h"
#include "core/mesh/bodies.h"
#include "core/mesh/patch_mesh.h"
#include "tests/fixtures/core/cube_scene.h"
#include "tests/fixtures/temporary_folder.h"

namespace scattermeter::capture {
namespace {

class ShotKeyTest : public ::testing::Test {
 protected:
  ShotKeyTest() : scene_(test_support::cube_scene()) {
    write_file(folder_ / "a.dng", std::string("samples"));
    write_file(folder_ / "cube.obj", std::string("mesh"));
    write_file(folder_ / "radiance.yaml", std::string("gain"));
    scene_.objects[0].mesh_path = folder_ / "cube.obj";
  }

  // Of the only shot, on patches of this size.
  std::string key(double patch_size_mm = 4.0) const {
    const ObjectScenes objects = test_support::cube_objects(scene_);
    const PatchMesh patches(objects.at("cube").mesh(), patch_size_mm);
    auto seen = std::make_shared<SeenObject>();
    seen->object = &objects.at("cube");
    seen->patches = &patches;
    ObservedShot shot;
    shot.stated = &scene_.shots[0];
    shot.seen = seen;
    shot.pose = pose_;
    FileDigests digests;
    return shot_key(scene_, decoding_, shot, {folder_ / "a.dng"}, digests);
  }

  TemporaryFolder folder_;
  Scene scene_;
  ShotDecoding decoding_;
  PoseResult pose_ = test_support::cube_pose();
};

TEST_F(ShotKeyTest, IsADigestAndTheSameForTheSame) {
  EXPECT_EQ(key().size(), 64U);
  EXPECT_EQ(key().find_first_not_of("0123456789abcdef"), std::string::npos);
  EXPECT_EQ(key(), key());
}

TEST_F(ShotKeyTest, ChangesWithAllThatDecodingRestsOn) {
  const std::string before = key();
  EXPECT_NE(key(2.0), before);
  const std::pair<const char*, std::function<void()>> changes[] = {
      {"samples", [&] { write_file(folder_ / "a.dng", std::string("Samples")); }},
      {"mesh", [&] { write_file(folder_ / "cube.obj", std::string("Mesh")); }},
      {"focal length", [&] { scene_.camera.intrinsics.fx_px += 1e-9; }},
      {"distortion", [&] { scene_.camera.intrinsics.distortion = {0.0}; }},
      {"eta", [&] { scene_.objects[0].eta_int_over_ext += 1e-9; }},
      {"edges", [&] { scene_.objects[0].edge_std_mm += 1e-9; }},
      {"position", [&] { scene_.objects[0].position_std_mm += 1e-9; }},
      {"pose", [&] { pose_.camera_from_world.translation_mm.z() += 1e-9; }},
      {"noise", [&] { scene_.camera.sensor.noise.gain_e_per_count += 1.0; }},
      {"responsivity",
       [&] {
         scene_.camera.responsivity = {1.0, 1.0, 1.0};
       }},
      {"camera", [&] { scene_.camera.model = "D80"; }},
      {"name", [&] { scene_.shots[0].file = "b.dng"; }},
      {"radiance",
       [&] {
         decoding_.radiance = std::make_shared<RadianceCalibration>();
         decoding_.radiance_path = folder_ / "radiance.yaml";
       }},
      {"radiance's content",
       [&] { write_file(folder_ / "radiance.yaml", std::string("other gain")); }},
  };
  std::string last = before;
  for (const auto& [what, change] : changes) {
    change();
    const std::string now = key();
    EXPECT_NE(now, last) << what;
    last = now;
  }
}

TEST_F(ShotKeyTest, LightsAndMaterialsHaveNoPartInIt) {
  const std::string before = key();
  scene_.lights[0].led()->led.exponent = 2.5;
  scene_.shots[0].material = "PE";
  scene_.shots[0].lights.clear();
  EXPECT_EQ(key(), before);
}

TEST_F(ShotKeyTest, NamesAFileThatCannotBeRead) {
  scene_.objects[0].mesh_path = folder_ / "none.obj";
  EXPECT_THROW(key(), InputError);
}

}  // namespace
}  // namespace scattermeter::capture
