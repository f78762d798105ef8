// Shots of several exposures: from the rig through the files to the answer.
#include "apps/instrument/open_shots.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "apps/instrument/instrument.h"
#include "apps/rig/open_objects.h"
#include "apps/simulation/virtual_shots.h"
#include "capture/sensor/radiance_calibration.h"
#include "core/base/input_error.h"
#include "tests/fixtures/apps/bracket_rig.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::json;
using OpenShots = BracketRig;

constexpr std::array<double, 3> kTruthS = {0.90, 1.05, 1.20};
constexpr std::array<double, 3> kTruthA = {0.002, 0.003, 0.006};

void expect_truth_inside(const Json& quantity, double truth) {
  EXPECT_LE(quantity["interval95"][0].get<double>(), truth);
  EXPECT_GE(quantity["interval95"][1].get<double>(), truth);
}

double of_budget(const Estimate& e, const std::string& cause) {
  for (const BudgetLine& line : e.budget) {
    if (line.cause == cause) return line.std_sigma_s_prime_per_mm;
  }
  return 0.0;
}

// The long exposure is clipped on most of the pyramid and says what is in the shadow; the short one
// alone is noisy.
TEST_F(OpenShots, MeasuresWhatOneExposureClips) {
  list("[short.dng, long.dng]", "[0.005, 0.25]");
  rig_.simulate();
  const Answer both = rig_.measure({"--model", "dipole"});
  EXPECT_EQ(both.status, 0) << both.out << both.err;
  EXPECT_EQ(both.err, "");
  EXPECT_THAT(both.out, HasSubstr("bracket short.dng: 2 files merged"));
  const Json merged = Json::parse(rig_.result());
  for (std::size_t c = 0; c < 3; ++c) {
    const Json& r = merged["results"][c];
    expect_truth_inside(r["sigma_s_prime_per_mm"], kTruthS[c]);
    expect_truth_inside(r["sigma_a_per_mm"], kTruthA[c]);
    EXPECT_EQ(r["patches_left_out"]["clipped"], 0);
    EXPECT_EQ(r["shots"], Json::array({"short.dng"}));
  }
  ASSERT_EQ(merged["brackets"].size(), 1U);
  const Json& bracket = merged["brackets"][0];
  EXPECT_EQ(bracket["shot"], "short.dng");
  ASSERT_EQ(bracket["files"].size(), 2U);
  EXPECT_EQ(bracket["files"][1]["file"], "long.dng");
  EXPECT_NEAR(bracket["files"][1]["exposure_s"].get<double>(), 0.25, 1e-6);
  const double all = bracket["samples"]["G"];
  const double of_long = bracket["files"][1]["samples"]["G"];
  EXPECT_EQ(bracket["files"][0]["samples"]["G"], bracket["samples"]["G"]);
  EXPECT_GT(of_long, 0.02 * all);
  EXPECT_LT(of_long, 0.9 * all);
  EXPECT_EQ(bracket["samples_clipped_in_all"]["G"], 0);
  EXPECT_THAT(merged["inputs"].dump(), HasSubstr("long.dng"));
  // The exposures agree about the light, to their noise.
  EXPECT_LT(std::abs(bracket["files"][1]["log_light_over_others"].get<double>()),
            5.0 * bracket["files"][1]["log_light_over_others_std"].get<double>());

  // The page tells it, too.
  EXPECT_THAT(slurp(rig_.out() + "/result.html"), HasSubstr("Bracket short.dng: 2 files merged"));

  // Each alone: the long one is refused, the short one less certain.
  rig_.write(replaced(rig_.text(), "[short.dng, long.dng], exposure_s: [0.005, 0.25]", "long.dng"));
  EXPECT_EQ(rig_.measure({"--model", "dipole"}).status, 1);
  rig_.write(replaced(rig_.text(), "long.dng", "short.dng"));
  EXPECT_EQ(rig_.measure({"--model", "dipole"}).status, 0);
  const Json single = Json::parse(rig_.result());
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_LT(merged["results"][c]["sigma_a_per_mm"]["std"].get<double>(),
              single["results"][c]["sigma_a_per_mm"]["std"].get<double>());
  }
  EXPECT_FALSE(single.contains("brackets"));
}

TEST_F(OpenShots, PaperMethodMerges) {
  list("[short.dng, long.dng]", "[0.005, 0.25]");
  rig_.simulate();
  EXPECT_LE(rig_.measure({"--model", "paper"}).status, 1);
  const Json paper = Json::parse(rig_.result());
  EXPECT_EQ(paper["brackets"].size(), 1U);
  EXPECT_EQ(paper["results"][1]["patches_left_out"]["clipped"], 0);
}

// A list of one is the file.
TEST_F(OpenShots, OfOneIsTheFile) {
  rig_.simulate();
  EXPECT_EQ(rig_.measure({"--model", "dipole"}).status, 0);
  const Json plain = Json::parse(rig_.result());
  list("[PE_pyramid_1.dng]", "[0.05]");
  EXPECT_EQ(rig_.measure({"--model", "dipole"}).status, 0);
  EXPECT_EQ(Json::parse(rig_.result())["results"], plain["results"]);
}

TEST_F(OpenShots, BadListsAreNamed) {
  list("[short.dng, long.dng]", "[0.005, 0.25]");
  rig_.simulate();
  const std::string good = rig_.text();
  rig_.write(replaced(good, "long.dng]", "gone.dng]"));
  expect_refused({"rig.yaml:", "shots.file", "gone.dng"});
  rig_.write(replaced(good, "long.dng]", "short.dng]"));
  expect_refused({"rig.yaml:", "shots[0].file[1]", "twice", "short.dng"});
  rig_.write(replaced(good, "[0.005, 0.25]", "[0.005]"));
  expect_refused({"rig.yaml:", "shots[0].exposure_s", "list of 2"});
  rig_.write(replaced(good, "[0.005, 0.25]", "0.005"));
  expect_refused({"rig.yaml:", "shots[0].exposure_s", "list of 2", "0.005"});
  rig_.write(replaced(good, "[short.dng, long.dng]", "[]"));
  expect_refused({"rig.yaml:", "shots[0].file", "bracket"});
  rig_.write(replaced(good, ", exposure_s: [0.005, 0.25]", ""));
  const Answer simulated = run({"simulate", rig_.rig(), "--out", rig_ / "other"});
  EXPECT_EQ(simulated.status, 2);
  EXPECT_THAT(simulated.err, HasSubstr("shots.exposure_s"));
  // Two shots may not share a file.
  rig_.write(
      replaced(good, "shots:\n",
               "shots:\n  - {file: long.dng, object: cube, material: PE, lights: [led1]}\n"));
  expect_refused({"rig.yaml:", "two shots of the same name", "long.dng"});
}

TEST_F(OpenShots, OtherIsoOrSizeIsNamed) {
  list("[short.dng, long.dng]", "[0.005, 0.25]");
  const std::string good = rig_.text();
  const auto long_one_of = [&](const std::string& from, const std::string& to) {
    rig_.write(replaced(good, from, to));
    rig_.simulate();
    std::filesystem::rename(rig_.shots() + "/long.dng", rig_ / "long.dng");
    rig_.write(good);
    rig_.simulate();
    std::filesystem::rename(rig_ / "long.dng", rig_.shots() + "/long.dng");
  };
  long_one_of("  exposure_s: 0.05", "  iso: 400\n  exposure_s: 0.05");
  expect_refused({"long.dng", "short.dng", "ISO 400", "ISO 100"});
  long_one_of("  exposure_s: 0.05", "  f_number: 11\n  exposure_s: 0.05");
  expect_refused({"long.dng", "short.dng", "f/11", "f/8"});
  long_one_of("image_size_px: [484, 324]", "image_size_px: [480, 324]");
  expect_refused({"long.dng", "480 x 324", "484 x 324"});
}

// A shutter that is off, and known to be: its times' uncertainty stays in the answer.
TEST_F(OpenShots, UncertainTimesStayInTheAnswer) {
  list("[short.dng, long.dng]", "[0.005, 0.25]");
  Rig rig = read_rig(rig_.rig());
  const ObjectScenes scenes = open_objects(rig);
  rig.truth.sensor.exposures = {{0.25, 0.255}};
  const VirtualShots shots(rig, scenes, {.noise = true});
  auto radiance = std::make_shared<capture::RadianceCalibration>();
  capture::RadianceCorrection& c = radiance->correction;
  c.width_px = rig.scene.camera.intrinsics.width_px;
  c.height_px = rig.scene.camera.intrinsics.height_px;
  c.iso = rig.scene.camera.iso;
  c.f_number = rig.scene.camera.f_number;
  c.black_counts.fill(64.0);
  c.noise.fill(rig.scene.camera.sensor.noise);
  c.vignetting = vignetting_of_frame(c.width_px, c.height_px);
  const auto measured = [&](double short_std, double long_std, double black_std) {
    c.shutter = {{0.005, 1.0, short_std}, {0.25, 1.0, long_std}};
    c.black_std_counts = black_std;
    use_radiance(rig, std::make_shared<const capture::RadianceCalibration>(*radiance), "");
    Instrument instrument(rig, scenes, {});
    const capture::FrameSource frames = [&](std::size_t i, std::size_t k) {
      return shots.frame(i, 1, k);
    };
    return instrument.measure(capture::shots_from(rig.scene, {0}, frames)).results.at(1).estimate;
  };
  const Estimate exact = measured(0.0, 0.0, 0.0);
  const Estimate open = measured(0.0, 0.02, 0.0);
  const Estimate wide = measured(0.02, 0.02, 0.0);
  ASSERT_TRUE(exact.converged && open.converged && wide.converged);
  EXPECT_EQ(of_budget(exact, "exposure time"), 0.0);
  EXPECT_GT(of_budget(open, "exposure time"), 0.0);
  EXPECT_GT(of_budget(wide, "exposure time"), of_budget(open, "exposure time"));
  // 2 % off in the long one alone: the fit finds it, and the answer holds.
  const auto time = std::find_if(open.pulls.begin(), open.pulls.end(),
                                 [](const PriorPull& p) { return p.name == "exposure 0.25"; });
  ASSERT_NE(time, open.pulls.end());
  EXPECT_NEAR(time->offset, 0.02, 0.005);
  EXPECT_LE(open.sigma_s_prime_per_mm.low95, kTruthS[1]);
  EXPECT_GE(open.sigma_s_prime_per_mm.high95, kTruthS[1]);
  EXPECT_LE(open.sigma_a_per_mm.low95, kTruthA[1]);
  EXPECT_GE(open.sigma_a_per_mm.high95, kTruthA[1]);
  // Each file has a black of its own.
  EXPECT_GT(of_budget(measured(0.0, 0.0, 0.5), "black level"), 0.0);
}

}  // namespace
}  // namespace scattermeter::apps
