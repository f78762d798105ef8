#include "apps/simulation/render.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "apps/rig/open_objects.h"
#include "apps/simulation/shot_renderer.h"
#include "capture/files/exr_file.h"
#include "tests/fixtures/apps/made_result.h"
#include "tests/fixtures/apps/small_rig.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

const MadeMaterials kMaterials = {{"POM", {{1.4, 1.6, 1.75}, {0.002, 0.004, 0.008}}},
                                  {"P/P", {{0.5, 0.62, 0.7}, {0.003, 0.002, 0.004}}}};

class RenderRun {
 public:
  explicit RenderRun(const nlohmann::json& result = made_result(kMaterials)) {
    rig_.keep_shots("POM_");
    write_file(rig_ / "result.json", result.dump());
  }
  Answer run_with(const std::vector<std::string>& more) const {
    std::vector<std::string> words = {"render", rig_.rig(), "--result", rig_ / "result.json",
                                      "--out",  rig_.out(), "--width",  "97"};
    words.insert(words.end(), more.begin(), more.end());
    return run(words);
  }
  capture::ProbeImage exr(const std::string& name) const {
    const std::string bytes = slurp(rig_.out() + "/" + name + ".exr");
    return capture::decode_exr(name, bytes, {});
  }
  SmallRig& rig() { return rig_; }

 private:
  SmallRig rig_;
};

double mean(const capture::ProbeImage& image) {
  return std::accumulate(image.radiance.begin(), image.radiance.end(), 0.0) /
         static_cast<double>(image.radiance.size());
}

// Columns in which anything is lit.
int lit_columns(int width, const std::vector<float>& rgb) {
  std::vector<bool> lit(static_cast<std::size_t>(width));
  for (std::size_t i = 0; i < rgb.size(); ++i) {
    if (rgb[i] > 0.0F) lit[i / 3 % lit.size()] = true;
  }
  return static_cast<int>(std::count(lit.begin(), lit.end(), true));
}

TEST(Render, WritesEveryMaterialOnEveryScene) {
  RenderRun run;
  run.rig().keep_shots("_1.dng");
  const Answer answer = run.run_with({});
  ASSERT_EQ(answer.status, 0) << answer.err;
  EXPECT_THAT(answer.out, HasSubstr("4 pictures"));
  const std::string table = slurp(run.rig().out() + "/pictures.csv");
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 5);
  EXPECT_THAT(table, HasSubstr("\ncube_led1_P_P,cube,led1,P/P,dipole,1.4,0.5 0.62 0.7,0.003 0.002 "
                               "0.004,"));
  EXPECT_EQ(slurp(run.rig().out() + "/sheet.png").substr(1, 3), "PNG");
  const std::string bytes = slurp(run.rig().out() + "/pyramid_led1_POM.exr");
  EXPECT_THAT(bytes, HasSubstr("W/(mm^2 sr)"));
  // POM, which scatters more, is brighter than PP.
  EXPECT_GT(mean(run.exr("cube_led1_POM")), mean(run.exr("cube_led1_P_P")));
  // A frame of a fifth of the pixels across shows the cube a fifth as wide.
  Rig rig = read_rig(run.rig().rig());
  rig.truth.materials["POM"] = {Medium{1.4, 0.002}, Medium{1.6, 0.004}, Medium{1.75, 0.008}};
  const ObjectScenes scenes = open_objects(rig);
  const ColourRadiance full = ShotRenderer(rig, scenes).render_colour(rig.scene.shots[0]);
  const capture::ProbeImage small = run.exr("cube_led1_POM");
  EXPECT_NEAR(lit_columns(small.width_px, small.radiance),
              lit_columns(full.width, full.rgb) * 97.0 / 484.0, 2.0);
  // And the same light: sums over the pixels, each of which is (484 / 97)^2 as large.
  const double sum = std::accumulate(full.rgb.begin(), full.rgb.end(), 0.0);
  const double small_sum = mean(small) * static_cast<double>(small.radiance.size());
  EXPECT_NEAR(small_sum * std::pow(484.0 / 97.0, 2), sum, 0.01 * sum);
}

TEST(Render, ChoosesMaterialObjectAndLight) {
  RenderRun run;
  const Answer answer =
      run.run_with({"--material", "POM", "--object", "cube", "--light", "led1", "--light", "led2"});
  ASSERT_EQ(answer.status, 0) << answer.err;
  const capture::ProbeImage both = run.exr("cube_led1_led2_POM");
  ASSERT_EQ(run.run_with({"--material", "POM", "--object", "cube"}).status, 0);
  // Light adds up.
  const capture::ProbeImage one = run.exr("cube_led1_POM");
  const capture::ProbeImage two = run.exr("cube_led2_POM");
  for (std::size_t i = 0; i < both.radiance.size(); ++i) {
    ASSERT_NEAR(both.radiance[i], one.radiance[i] + two.radiance[i], 1e-5F * both.radiance[i]);
  }
  EXPECT_THAT(run.run_with({"--object", "sphere"}).err,
              HasSubstr("has no object sphere, only cube, pyramid"));
  EXPECT_THAT(run.run_with({"--light", "sun"}).err, HasSubstr("has no light sun, only led1, led2"));
  EXPECT_EQ(run.run_with({"--material", "PVC"}).status, 2);
}

// Both models, on a cube whose light the dipole tells within some percent.
TEST(Render, TransportComesNearTheDipole) {
  RenderRun run;
  const std::vector<std::string> scene = {"--material", "POM",     "--object",
                                          "cube",       "--light", "led1"};
  ASSERT_EQ(run.run_with(scene).status, 0);
  const double dipole = mean(run.exr("cube_led1_POM"));
  std::vector<std::string> words = scene;
  words.insert(words.end(), {"--model", "transport", "--paths", "20000"});
  const Answer answer = run.run_with(words);
  ASSERT_EQ(answer.status, 0) << answer.err;
  EXPECT_THAT(answer.out, HasSubstr("Monte Carlo error"));
  EXPECT_NEAR(mean(run.exr("cube_led1_POM")), dipole, 0.1 * dipole);
  EXPECT_THAT(slurp(run.rig().out() + "/pictures.csv"), HasSubstr(",transport,"));
}

// The material brings its own eta, whatever the rig says of the object.
TEST(Render, EtaIsTheMaterials) {
  const std::vector<std::string> scene = {"--material", "POM",     "--object",
                                          "cube",       "--light", "led1"};
  RenderRun as_rig(made_result(kMaterials, 1.4)), other(made_result(kMaterials, 1.1));
  ASSERT_EQ(as_rig.run_with(scene).status, 0);
  ASSERT_EQ(other.run_with(scene).status, 0);
  RenderRun rig_of_other(made_result(kMaterials, 1.1));
  rig_of_other.rig().write(replaced(rig_of_other.rig().text(), "cube: {mesh: cube.obj, eta: 1.4}",
                                    "cube: {mesh: cube.obj, eta: 1.1}"));
  ASSERT_EQ(rig_of_other.run_with(scene).status, 0);
  EXPECT_EQ(other.exr("cube_led1_POM").radiance, rig_of_other.exr("cube_led1_POM").radiance);
  EXPECT_NE(other.exr("cube_led1_POM").radiance, as_rig.exr("cube_led1_POM").radiance);
}

TEST(Render, RefusedIsLeftOut) {
  nlohmann::json json = made_result(kMaterials);
  for (nlohmann::json& entry : json["results"]) {
    if (entry["material"] == "P/P") entry["verdict"] = "refused";
  }
  RenderRun run(json);
  const Answer answer = run.run_with({"--object", "cube", "--light", "led1"});
  EXPECT_EQ(answer.status, 1);
  EXPECT_THAT(answer.err, HasSubstr("P/P R is refused; left out"));
  EXPECT_TRUE(std::filesystem::exists(run.rig().out() + "/cube_led1_POM.exr"));
  EXPECT_FALSE(std::filesystem::exists(run.rig().out() + "/cube_led1_P_P.exr"));
  const Answer none = run.run_with({"--material", "P/P"});
  EXPECT_EQ(none.status, 1);
  EXPECT_THAT(none.err, HasSubstr("nothing is left to render"));
}

}  // namespace
}  // namespace scattermeter::apps
