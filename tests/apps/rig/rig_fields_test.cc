#include "apps/rig/rig_fields.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/apps/yaml_text.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

TEST(RigFields, RelativeNamesAreBesideTheRig) {
  EXPECT_EQ(beside("/shots/today/rig.yaml", "cube.obj"), "/shots/today/cube.obj");
  EXPECT_EQ(beside("/shots/rig.yaml", "meshes/cube.obj"), "/shots/meshes/cube.obj");
  EXPECT_EQ(beside("rig.yaml", "cube.obj"), "cube.obj");
  EXPECT_EQ(beside("/shots/rig.yaml", "/meshes/cube.obj"), "/meshes/cube.obj");
}

TEST(RigFields, AFileInTheFolderHasNoPath) {
  EXPECT_EQ(file_in_folder(yaml_text("file: a.dng").at("file")), "a.dng");
  EXPECT_EQ(file_in_folder(yaml_text("file: ..a").at("file")), "..a");
  for (const char* bad : {"sub/a.dng", "/a.dng", ".", ".."}) {
    EXPECT_THAT(
        refusal_of([&] { file_in_folder(yaml_text(std::string("file: ") + bad).at("file")); }),
        HasSubstr("rig.yaml:1: file: expected the name of a file"))
        << bad;
  }
}

TEST(RigFields, ThreeNumbers) {
  const YamlField f = yaml_text("some: [1, 2.5, 3e10]\nnone: [1, 0, 2]\nless: [1, 2, -1e-9]\n");
  EXPECT_EQ(positive_rgb(f.at("some")), (std::array<double, 3>{1, 2.5, 3e10}));
  EXPECT_EQ(rgb_not_negative(f.at("none")), (std::array<double, 3>{1, 0, 2}));
  EXPECT_THAT(refusal_of([&] { positive_rgb(f.at("none")); }), HasSubstr("three positive numbers"));
  EXPECT_THAT(refusal_of([&] { rgb_not_negative(f.at("less")); }), HasSubstr("at least 0"));
  EXPECT_NE(refusal_of([&] { positive_rgb(yaml_text("rgb: [1, 2]").at("rgb")); }), "");
}

TEST(RigFields, DirectionsAreNormalised) {
  const Eigen::Vector3d v = unit_vector(yaml_text("axis: [0, 30, -40]").at("axis"));
  EXPECT_NEAR((v - Eigen::Vector3d(0, 0.6, -0.8)).norm(), 0.0, 1e-15);
  EXPECT_THAT(refusal_of([] { unit_vector(yaml_text("axis: [0, 0, 0]").at("axis")); }),
              HasSubstr("axis: expected a direction other than zero"));
}

}  // namespace
}  // namespace scattermeter::apps
