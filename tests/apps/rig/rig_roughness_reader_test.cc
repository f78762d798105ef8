#include "apps/rig/rig_roughness_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "apps/rig/rig.h"
#include "core/base/input_error.h"
#include "tests/fixtures/apps/small_rig.h"

namespace scattermeter::apps {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

class RigRoughnessReader : public testing::Test {
 protected:
  SceneObject cube(const std::string& roughness) {
    small_.write(
        replaced(text_, "cube.obj, eta: 1.4", "cube.obj, eta: 1.4, roughness: " + roughness));
    return read_rig(small_.rig()).scene.object("cube");
  }
  SmallRig small_;
  const std::string text_ = small_.text();
};

TEST_F(RigRoughnessReader, ReadsNumbersAndFinishes) {
  EXPECT_EQ(read_rig(small_.rig()).scene.object("cube").surface_alpha, 0.0);
  EXPECT_EQ(read_rig(small_.rig()).scene.object("cube").surface_alpha_std, 0.03);
  EXPECT_EQ(cube("{alpha: 0.2, alpha_std: 0.05}").surface_alpha, 0.2);
  EXPECT_EQ(cube("{alpha: 0.2, alpha_std: 0.05}").surface_alpha_std, 0.05);
  EXPECT_NEAR(cube("{alpha: 0.2}").surface_alpha_std, 0.06, 1e-15);
  EXPECT_EQ(cube("{alpha: 0}").surface_alpha_std, 0.0);
  EXPECT_EQ(cube("{alpha: 0, alpha_std: 0.05}").surface_alpha_std, 0.05);
  EXPECT_EQ(cube("polished").surface_alpha, 0.03);
  EXPECT_EQ(cube("as-milled").surface_alpha, 0.15);
  EXPECT_EQ(cube("matt").surface_alpha, 0.35);
  EXPECT_EQ(cube("matt").surface_alpha_std, 0.1);
}

TEST_F(RigRoughnessReader, NamesWhatIsWrong) {
  const auto says = [](const std::string& a, const std::string& b) {
    return ThrowsMessage<InputError>(AllOf(HasSubstr(a), HasSubstr(b)));
  };
  EXPECT_THAT([&] { cube("shiny"); }, says("objects.cube.roughness", "as-milled"));
  EXPECT_THAT([&] { cube("{alpha: 0.6}"); }, says("objects.cube.roughness.alpha", "0.6"));
  EXPECT_THAT([&] { cube("{alpha: 0.005}"); }, says("objects.cube.roughness.alpha", "0.01"));
  EXPECT_THAT([&] { cube("{alpha_std: 0.1}"); }, says("objects.cube.roughness.alpha", "missing"));
  EXPECT_THAT([&] { cube("{alpha: 0, alpha_std: 0.1}"); },
              says("objects.cube.roughness.alpha_std", "smooth"));
  EXPECT_THAT([&] { cube("{alpha: 0.1, beta: 1}"); },
              says("objects.cube.roughness.beta", "unknown key"));
}

TEST_F(RigRoughnessReader, KnowsNoReflectionOfAPicture) {
  Scene scene;
  scene.objects.push_back({});
  scene.objects.back().name = "cube";
  scene.lights.push_back({"sky", DistantLight{}, {}, 0});
  scene.shots.push_back({"a.dng", "cube", "PP", {"sky"}, {}, {}, {}, 0});
  EXPECT_NO_THROW(require_lights_of_rough_objects(scene));
  scene.objects.back().surface_alpha = 0.1;
  EXPECT_THAT([&] { require_lights_of_rough_objects(scene); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("sky"), HasSubstr("cube"))));
}

}  // namespace
}  // namespace scattermeter::apps
