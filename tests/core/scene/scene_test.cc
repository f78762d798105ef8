#include "core/scene/scene.h"

#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/input_error.h"

namespace scattermeter {
namespace {

Scene two_materials() {
  Scene scene;
  scene.source = "rig.yaml";
  scene.objects.resize(1);
  scene.objects[0].name = "cube";
  scene.lights.resize(3);
  scene.lights[0].name = "led";
  scene.lights[1] = {"hall", DistantLight(), {}, 7};
  scene.lights[2] = {"room", AmbientLight(), {}, 8};
  for (const char* material : {"POM", "PE", "POM"}) {
    SceneShot& shot = scene.shots.emplace_back();
    shot.file = std::string(material) + std::to_string(scene.shots.size()) + ".dng";
    shot.material = material;
  }
  return scene;
}

TEST(Scene, FindsByName) {
  const Scene scene = two_materials();
  EXPECT_EQ(scene.object("cube").name, "cube");
  EXPECT_EQ(scene.light("hall").line, 7);
  EXPECT_THROW(scene.object("sphere"), std::out_of_range);
  EXPECT_THROW(scene.light("lamp"), std::out_of_range);
  EXPECT_EQ(scene.at(12), "rig.yaml:12");
  EXPECT_EQ(scene.at(0), "rig.yaml");
}

TEST(Scene, ShotsThatNameWhatIsNotThereAreRefused) {
  Scene scene = two_materials();
  for (SceneShot& shot : scene.shots) {
    shot.object = "cube";
    shot.lights = {"led", "room"};
  }
  EXPECT_NO_THROW(require_known_names(scene));
  const auto message = [](const Scene& bad) {
    try {
      require_known_names(bad);
    } catch (const InputError& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  Scene bad = scene;
  bad.shots[1].object = "sphere";
  EXPECT_EQ(message(bad), "rig.yaml: shots.PE2.dng.object: sphere is not one of the objects");
  bad = scene;
  bad.shots[2].lights = {"led", "lamp"};
  EXPECT_EQ(message(bad), "rig.yaml: shots.POM3.dng.lights: lamp is not one of the lights");
  bad.shots[2].lights.clear();
  EXPECT_EQ(message(bad), "rig.yaml: shots.POM3.dng.lights: expected at least one light");
}

TEST(Scene, MaterialsComeInTheOrderOfTheirFirstShot) {
  EXPECT_EQ(two_materials().materials(), (std::vector<std::string>{"POM", "PE"}));
}

TEST(Scene, FilesOfABracketStartWithTheShot) {
  SceneShot shot;
  shot.file = "a.dng";
  shot.more_files = {"b.dng", "c.dng"};
  EXPECT_EQ(shot.files(), (std::vector<std::string>{"a.dng", "b.dng", "c.dng"}));
}

TEST(Scene, LightsAreValues) {
  Scene scene = two_materials();
  ASSERT_NE(scene.lights[0].led(), nullptr);
  EXPECT_EQ(scene.lights[1].led(), nullptr);
  EXPECT_EQ(scene.lights[0].channel_of(2), 0U);
  EXPECT_EQ(scene.lights[1].channel_of(2), 2U);
  EXPECT_EQ(scene.lights[2].channel_of(2), 0U);
  // A copy is a light of its own.
  Scene other = scene;
  other.lights[0].led()->led.position_mm.x() = 5.0;
  EXPECT_EQ(scene.lights[0]->position_mm()->x(), 0.0);
  EXPECT_EQ(other.lights[0]->position_mm()->x(), 5.0);
}

}  // namespace
}  // namespace scattermeter
