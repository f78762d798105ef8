#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "apps/rig/rig.h"
#include "core/base/input_error.h"
#include "core/scene/default_uncertainty.h"
#include "tests/fixtures/apps/small_rig.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

struct Mistake {
  const char* name;
  const char* from;
  const char* to;
  std::vector<const char*> message;  // parts of the one sentence
};

class RigMistake : public ::testing::TestWithParam<Mistake> {};

TEST_P(RigMistake, IsNamed) {
  SmallRig rig;
  rig.keep_shots("POM");
  rig.write(replaced(rig.text(), GetParam().from, GetParam().to));
  try {
    read_rig(rig.rig());
    FAIL() << "no mistake was found";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("rig.yaml:"));
    for (const char* part : GetParam().message) EXPECT_THAT(e.what(), HasSubstr(part));
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, RigMistake,
    ::testing::Values(
        Mistake{
            "Version", "scattermeter_rig: 1", "scattermeter_rig: 2", {"scattermeter_rig", "got 2"}},
        Mistake{"NaN",
                "fx_px: 1229.5",
                "fx_px: .nan",
                {":5", "camera.intrinsics.fx_px", "finite", ".nan"}},
        Mistake{"Infinity", "cx_px: 241.8", "cx_px: .inf", {"camera.intrinsics.cx_px", "finite"}},
        Mistake{"Negative",
                "fy_px: 1229.5",
                "fy_px: -1",
                {"camera.intrinsics.fy_px", "positive", "-1"}},
        Mistake{"NotANumber",
                "exposure_s: 0.05",
                "exposure_s: soon",
                {"camera.exposure_s", "number", "soon"}},
        Mistake{"UnknownKey",
                "  exposure_s: 0.05",
                "  exposure: 0.05",
                {"camera.exposure", "unknown key", "exposure_s"}},
        Mistake{"GivenTwice",
                "  exposure_s: 0.05",
                "  exposure_s: 0.05\n  exposure_s: 0.06",
                {"camera.exposure_s", "given twice"}},
        Mistake{"WrongLength",
                "image_size_px: [484, 324]",
                "image_size_px: [484]",
                {"camera.image_size_px", "2 numbers", "[484]"}},
        Mistake{"ZeroSize",
                "image_size_px: [484, 324]",
                "image_size_px: [0, 324]",
                {"camera.image_size_px[0]", "got 0"}},
        Mistake{"NegativeResponsivity",
                "[2.4e10, 2.9e10, 2.1e10]",
                "[2.4e10, -1, 2.1e10]",
                {"responsivity", "positive"}},
        Mistake{"NegativeGain",
                "gain_e_per_count: 6.0",
                "gain_e_per_count: 0",
                {"camera.sensor.gain_e_per_count"}},
        Mistake{"Eta",
                "cube: {mesh: cube.obj, eta: 1.4}",
                "cube: {mesh: cube.obj, eta: 0.7}",
                {"objects.cube.eta", "0.7"}},
        Mistake{"NoMesh",
                "cube: {mesh: cube.obj, eta: 1.4}",
                "cube: {eta: 1.4}",
                {"objects.cube.mesh", "missing"}},
        Mistake{"ZeroAxis",
                "axis: [-30, 60, -70]",
                "axis: [0, 0, 0]",
                {"lights.led1.axis", "direction"}},
        Mistake{"NegativePower",
                "axis: [-30, 60, -70], exponent: 1, intensity_W_per_sr: [0.05, 0.05, 0.05]",
                "axis: [-30, 60, -70], exponent: 1, intensity_W_per_sr: [0.05, -0.05, 0.05]",
                {"lights.led1.intensity_W_per_sr", "-0.05"}},
        Mistake{"NegativeExponent",
                "axis: [-30, 60, -70], exponent: 1",
                "axis: [-30, 60, -70], exponent: -1",
                {"lights.led1.exponent", "-1"}},
        Mistake{
            "LightType", "led1: {type: led,", "led1: {type: laser,", {"lights.led1.type", "laser"}},
        Mistake{"LedNamedAsAnObject",
                "\nlights:\n  led1:",
                "\nlights:\n  cube:",
                {"lights.cube", "is the name of an object, too"}},
        Mistake{"UnknownObject",
                "POM_cube_1.dng, object: cube",
                "POM_cube_1.dng, object: ball",
                {"shots[0].object", "ball"}},
        Mistake{"UnknownLight",
                "{file: POM_cube_1.dng, object: cube, material: POM, lights: [led1]}",
                "{file: POM_cube_1.dng, object: cube, material: POM, lights: [sun]}",
                {"shots[0].lights", "sun"}},
        Mistake{"NoLight",
                "{file: POM_cube_1.dng, object: cube, material: POM, lights: [led1]}",
                "{file: POM_cube_1.dng, object: cube, material: POM, lights: []}",
                {"shots[0].lights", "at least one"}},
        Mistake{"SameNameTwice",
                "file: POM_cube_2.dng",
                "file: POM_cube_1.dng",
                {"shots[1].file", "same name", "POM_cube_1.dng"}},
        Mistake{"PathInName",
                "file: POM_cube_2.dng",
                "file: ../POM_cube_2.dng",
                {"shots[1].file", "../POM_cube_2.dng"}},
        Mistake{"NegativeTruth",
                "sigma_a_per_mm: [0.002, 0.004, 0.008]",
                "sigma_a_per_mm: [0.002, -0.004, 0.008]",
                {"truth.materials.POM.sigma_a_per_mm"}},
        Mistake{"TimeThatNoFileStates",
                "exposure_s: 0.05",
                "exposure_s: 1e-10",
                {"camera.exposure_s", "1e-10"}},
        Mistake{"IsoBeyondExif",
                "  exposure_s: 0.05",
                "  exposure_s: 0.05\n  iso: 65535",
                {"camera.iso", "65535"}},
        Mistake{"Aperture",
                "  exposure_s: 0.05",
                "  exposure_s: 0.05\n  f_number: 1e10",
                {"camera.f_number", "1e10"}},
        Mistake{"BlankModel",
                "model: NIKON D80",
                "model: ' D80'",
                {"camera.model", "begins with a blank"}},
        Mistake{"BothPoses",
                "pose:\n",
                "pose:\n  charuco: {squares: [5, 7], square_mm: 10, marker_mm: 7}\n",
                {"pose", "either points or charuco"}},
        Mistake{"GammaBeyondG",
                "cube.obj, eta: 1.4",
                "cube.obj, eta: 1.4, phase: {g: 0.5, gamma: 1.7}",
                {"objects.cube.phase.gamma", "1.5", "1.7"}},
        Mistake{"GammaStdWithoutGamma",
                "cube.obj, eta: 1.4",
                "cube.obj, eta: 1.4, phase: {g: 0.5, gamma_std: 0.2}",
                {"objects.cube.phase.gamma_std", "unknown key", "g_std"}},
        Mistake{"LampCopied",
                "[-70, -20, 60], axis: [70, 20, -50]",
                "[30, -60, 80], axis: [-30, 60, -70]",
                {"lights.led2", "position, axis and intensity of led1"}},
        Mistake{"NotYaml", "camera:", "camera: [", {"YAML"}}),
    [](const auto& mistake) { return mistake.param.name; });

TEST(RigReader, ReadsEverything) {
  SmallRig small;
  const Rig rig = read_rig(small.rig());
  EXPECT_EQ(rig.scene.shots.size(), 12U);
  EXPECT_EQ(rig.scene.materials(), (std::vector<std::string>{"PP", "PE", "POM"}));
  EXPECT_EQ(rig.scene.camera.intrinsics.width_px, 484);
  EXPECT_EQ(rig.scene.camera.responsivity->at(1), 2.9e10);
  EXPECT_EQ(rig.scene.light("led2").led()->led.position_mm, Eigen::Vector3d(-70, -20, 60));
  EXPECT_NEAR(rig.scene.light("led2").led()->led.axis.norm(), 1.0, 1e-15);
  EXPECT_EQ(rig.scene.object("cube").eta_int_over_ext, 1.4);
  EXPECT_EQ(rig.pose.points.size(), 8U);
  EXPECT_EQ(rig.truth.materials.at("PE")[2].sigma_a_per_mm, 0.006);
}

TEST(RigReader, PhaseFunctions) {
  SmallRig small;
  const std::string text = small.text();
  const auto cube = [&](const std::string& phase) {
    small.write(replaced(text, "cube.obj, eta: 1.4", "cube.obj, eta: 1.4, phase: " + phase));
    return read_rig(small.rig()).scene.object("cube");
  };
  EXPECT_TRUE(read_rig(small.rig()).scene.object("cube").phase.is_isotropic());
  EXPECT_EQ(read_rig(small.rig()).scene.object("cube").gamma_std, default_uncertainty::kGamma);
  EXPECT_EQ(cube("{g: 0.8}").phase, PhaseFunction(0.8));
  EXPECT_EQ(cube("{g: 0.8}").gamma_std, 0.1);
  EXPECT_EQ(cube("{g: 0.8, g_std: 0}").gamma_std, 0.0);
  EXPECT_EQ(cube("{g: 0.8, gamma: 1.6, gamma_std: 0.2}").phase,
            PhaseFunction::with_gamma(0.8, 1.6));
  EXPECT_EQ(cube("{g: 0.8, gamma: 1.6, gamma_std: 0.2}").gamma_std, 0.2);
  EXPECT_EQ(cube("{g: 0.9, share: 0.9, other_g: -0.5}").phase,
            PhaseFunction::mixture(0.9, 0.9, -0.5));
}

// The mesh is looked for beside the rig, wherever the program runs.
TEST(RigReader, PathsAreRelativeToTheRig) {
  SmallRig small;
  EXPECT_EQ(read_rig(small.rig()).scene.object("cube").mesh_path, small / "cube.obj");
}

TEST(RigReader, MissingFile) {
  EXPECT_THROW(read_rig("/nowhere/rig.yaml"), InputError);
  EXPECT_THROW(read_rig("/"), InputError);
}

TEST(RigReader, KnowsAResult) {
  SmallRig small;
  small.write("{\"$schema\": \"result.schema.json\", \"results\": []}");
  EXPECT_THAT([&] { read_rig(small.rig()); },
              ThrowsMessage<InputError>(HasSubstr("is a result of `measure`, not a rig")));
}

// The sample's own rig reads, and its twelve shots are the paper's.
TEST(RigReader, SampleRig) {
  const Rig rig =
      read_rig(std::string(SCATTERMETER_SOURCE_DIR) + "/samples/three_plastics/rig.yaml");
  EXPECT_EQ(rig.scene.shots.size(), 12U);
  EXPECT_EQ(rig.scene.camera.intrinsics.width_px, 3872);
}

}  // namespace
}  // namespace scattermeter::apps
