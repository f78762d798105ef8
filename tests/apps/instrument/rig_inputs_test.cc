#include "apps/instrument/rig_inputs.h"

#include <gtest/gtest.h>

#include "core/base/input_error.h"
#include "core/mesh/bodies.h"
#include "tests/fixtures/temporary_folder.h"

namespace scattermeter::apps {
namespace {

// FIPS 180-4's examples: of "abc", of nothing.
constexpr const char* kDigestOfAbc =
    "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
constexpr const char* kDigestOfNothing =
    "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855";

class RigInputs : public ::testing::Test {
 protected:
  RigInputs() {
    for (const char* name : {"rig.yaml", "camera.yaml", "radiance.yaml", "cube.obj", "led1.yaml",
                             "shot1.dng", "shot2.dng"}) {
      write_file(folder_ / name, std::string("abc"));
    }
    write_file(folder_ / "sky.hdr", std::string());
    rig_.path = rig_.scene.source = folder_ / "rig.yaml";
    rig_.scene.objects.resize(1);
    rig_.scene.objects[0].name = "cube";
    rig_.scene.objects[0].mesh_path = folder_ / "cube.obj";
    for (const auto& [name, file] :
         {std::pair{"led1", "led1.yaml"}, {"sky", "sky.hdr"}, {"unused", "gone.yaml"}}) {
      SceneLight light;
      light.name = name;
      light.files = {folder_ / file};
      if (light.name == "led1") light.led()->led.position_mm = {0, 0, 90};
      if (light.name != "led1") light.kind = AmbientLight{};
      rig_.scene.lights.push_back(light);
    }
    SceneShot shot;
    shot.object = "cube";
    shot.lights = {"led1"};
    rig_.scene.shots = {shot, shot};
    rig_.scene.shots[1].lights = {"sky", "led1"};
    objects_ = open_objects(rig_, [](const SceneObject&) { return cube_mesh(); });
  }
  std::vector<std::string> paths(const std::vector<InputFile>& inputs) const {
    std::vector<std::string> out;
    for (const InputFile& f : inputs) out.push_back(f.path.substr(folder_.path().size() + 1));
    return out;
  }
  TemporaryFolder folder_;
  Rig rig_;
  ObjectScenes objects_;
  capture::FileDigests digests_;
};

TEST_F(RigInputs, EachFileOnceInAFixedOrder) {
  rig_.intrinsics_path = folder_ / "camera.yaml";
  rig_.decoding.radiance_path = folder_ / "radiance.yaml";
  const std::vector<InputFile> inputs =
      rig_inputs(rig_, objects_, digests_, {folder_ / "shot1.dng", folder_ / "shot2.dng"});
  EXPECT_EQ(paths(inputs),
            (std::vector<std::string>{"rig.yaml", "camera.yaml", "radiance.yaml", "cube.obj",
                                      "led1.yaml", "sky.hdr", "shot1.dng", "shot2.dng"}));
  for (const InputFile& f : inputs) {
    EXPECT_EQ(f.sha256, f.path.ends_with("sky.hdr") ? kDigestOfNothing : kDigestOfAbc) << f.path;
  }
}

TEST_F(RigInputs, OnlyWhatThereIs) {
  EXPECT_EQ(paths(rig_inputs(rig_, objects_, digests_)),
            (std::vector<std::string>{"rig.yaml", "cube.obj", "led1.yaml", "sky.hdr"}));
}

TEST_F(RigInputs, NamesAFileThatIsGone) {
  rig_.scene.shots[0].lights = {"unused"};
  try {
    rig_inputs(rig_, objects_, digests_);
    ADD_FAILURE() << "digested a file that is not there";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find(folder_ / "gone.yaml"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace scattermeter::apps
