#include "apps/planning/plan.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "apps/bench/bench_plan.h"
#include "apps/planning/shadow_card.h"
#include "apps/report/plan_page.h"
#include "apps/simulation/bodies_rig.h"
#include "capture/sensor/radiance_calibration.h"
#include "core/light/incident_light.h"
#include "tests/fixtures/apps/html_check.h"
#include "tests/fixtures/apps/small_rig.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::json;

std::array<Medium, 3> plastic() {
  return {Medium{0.9, 0.002, 1.0}, Medium{1.2, 0.004, 1.0}, Medium{1.5, 0.008, 1.0}};
}

// One body under one or two LEDs, 320 px wide.
Rig body_rig(const std::string& body, int leds) {
  Rig rig = bodies_rig(320, 1.4, {{"plastic", plastic()}}, {body});
  rig.path = "";
  rig.scene.shots.resize(static_cast<std::size_t>(leds));
  return rig;
}

// What it forecasts is what measuring then states: other bodies, lights, and causes that count.
TEST(Plan, AgreesWithMeasure) {
  std::vector<Rig> rigs = {body_rig("cube", 2), body_rig("pyramid", 1), body_rig("sphere", 2),
                           body_rig("scan", 1)};
  rigs[0].scene.camera.responsivity_relative_std = 0.02;
  rigs[1].scene.camera.responsivity.reset();  // a free scale
  for (SceneLight& light : rigs[2].scene.lights) {
    light.led()->position_std_mm = 0.3;
    light.led()->exponent_std = 0.05;
    light.led()->intensity_relative_std = 0.01;
  }
  rigs[3].pose.options.point_std_px = 0.1;
  rigs[3].scene.objects[0].eta_std = 0.01;
  for (std::size_t i = 0; i < rigs.size(); ++i) {
    const ObjectScenes scenes = bodies_scenes(rigs[i]);
    const std::vector<PlanBenchRow> rows = plan_and_measure(rigs[i], scenes, 7);
    ASSERT_EQ(rows.size(), 3U);
    for (const PlanBenchRow& row : rows) {
      EXPECT_EQ(row.planned, row.measured) << i << row.channel;
      EXPECT_TRUE(row.planned) << i << row.channel;
      EXPECT_NEAR(std::log(row.forecast_sigma_s_prime / row.stated_sigma_s_prime), 0.0,
                  std::log(1.25))
          << i << row.channel;
      EXPECT_NEAR(std::log(row.forecast_sigma_a / row.stated_sigma_a), 0.0, std::log(1.25))
          << i << row.channel;
    }
  }
}

// The forecast is made of the causes that result.json then has, line by line.
TEST(Plan, FilesHoldTheForecast) {
  SmallRig files;
  files.keep_shots("PE_cube");
  const Answer r = run({"plan", files.rig(), "--out", files.out()});
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.out, HasSubstr("exposure: nothing clips, nothing is too dark"));
  EXPECT_THAT(r.out, HasSubstr("a scale twice as well known (0.5 %)"));
  const Json plan = Json::parse(slurp(files.out() + "/plan.json"));
  EXPECT_EQ(html_problem(slurp(files.out() + "/plan.html")), "");
  for (const char* map : {"/plan_map_1.png", "/plan_map_2.png"}) {
    EXPECT_GT(std::filesystem::file_size(files.out() + map), 5000U);
  }
  // Nothing else: no temporary file is left.
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(files.out()), {}), 4);
  EXPECT_EQ(plan["assumes"]["noise"], "camera.sensor");
  EXPECT_EQ(plan["assumes"]["noise_model"]["G"]["gain_e_per_count"], 6.0);

  files.simulate();
  ASSERT_EQ(files.measure({"--model", "dipole"}).status, 0);
  const Json result = Json::parse(files.result());
  ASSERT_EQ(plan["forecast"].size(), result["results"].size());
  for (std::size_t i = 0; i < 3; ++i) {
    const Json& f = plan["forecast"][i];
    const Json& m = result["results"][i];
    EXPECT_EQ(f["channel"], m["channel"]);
    EXPECT_EQ(f["shots"], m["shots"]);
    ASSERT_EQ(f["budget"].size(), m["budget"].size());
    for (std::size_t k = 0; k < f["budget"].size(); ++k) {
      EXPECT_EQ(f["budget"][k]["cause"], m["budget"][k]["cause"]);
    }
    for (const char* name : {"sigma_s_prime_per_mm", "sigma_a_per_mm"}) {
      const double ratio = f[name]["std"].get<double>() / m[name]["std"].get<double>();
      EXPECT_NEAR(std::log(ratio), 0.0, std::log(1.25)) << name << i;
    }
  }
}

// More shots and better known quantities never tell less; the coarse forecast is no other one.
TEST(Plan, SuggestedShotsHelp) {
  Rig rig = body_rig("cube", 1);
  rig.scene.camera.responsivity_relative_std = 0.02;
  // A mean free path longer than the patches of 1.8 mm keeps the errors of the method small: they
  // are not fitted, and another shot may weigh them otherwise.
  rig.truth.materials["plastic"].fill({0.5, 0.004, 1.0});
  const ObjectScenes scenes = bodies_scenes(rig);
  PlanOptions options;

  const Plan made = plan(rig, scenes, options);
  ASSERT_EQ(made.suggested_shots.size(), 1U);
  const SuggestedShots& other = made.suggested_shots[0];
  EXPECT_GT(other.coarse_ratio, 0.6);
  EXPECT_LT(other.coarse_ratio, 1.7);
  EXPECT_GE(other.gains.size(), 4U);
  for (std::size_t i = 0; i < other.gains.size(); ++i) {
    EXPECT_LT(other.gains[i].sigma_a_ratio, 1.001) << other.gains[i].what;
    EXPECT_GT(other.gains[i].sigma_a_ratio, 0.0) << other.gains[i].what;
    if (i == 0) continue;
    EXPECT_GE(other.gains[i].sigma_a_ratio, other.gains[i - 1].sigma_a_ratio);
  }
  ASSERT_EQ(other.maps.size(), 1U);
  const LedMap& map = other.maps[0];
  std::size_t answers = 0;
  for (const LedPosition& at : map.positions) {
    EXPECT_NEAR((at.position_mm - map.center_mm).norm(), map.distance_mm, 1e-9);
    if (!std::isfinite(at.joined)) continue;
    ++answers;
    EXPECT_LT(at.joined, 1.02 * other.planned);
    if (!std::isfinite(at.alone)) continue;
    EXPECT_LT(at.joined, 1.02 * at.alone);
  }
  EXPECT_GT(answers, 60U);
  EXPECT_EQ(html_problem(plan_page(made, "<script>")), "");
  EXPECT_THAT(plan_page(made, "<script>"), ::testing::Not(HasSubstr("<script>")));
}

TEST(Plan, KnownCausesTakeTheirLineOut) {
  Estimate e;
  e.sigma_s_prime_per_mm.std = 5.0;
  e.sigma_a_per_mm.std = 5.0;
  e.budget = {{"noise", 1.0, 1.0}, {"pose", 3.0, 3.0}, {"scale", 0.0, 4.0}, {"numerics", 1.0, 1.0}};
  const std::vector<KnownCause> known = known_causes(e);
  ASSERT_EQ(known.size(), 2U);
  EXPECT_EQ(known[0].cause, "scale");
  EXPECT_DOUBLE_EQ(known[0].sigma_a_std_per_mm, 3.0);
  EXPECT_DOUBLE_EQ(known[1].sigma_s_prime_std_per_mm, 4.0);
}

TEST(Plan, RangeInPlaceOfTruth) {
  SmallRig files;
  files.keep_shots("PE_cube_1");
  const std::string truth = files.text().substr(files.text().find("truth:"));
  files.write(replaced(files.text(), truth, ""));
  const Answer none = run({"plan", files.rig(), "--fast"});
  EXPECT_EQ(none.status, 2);
  EXPECT_THAT(none.err, HasSubstr("truth.materials.PE: is missing"));
  EXPECT_THAT(none.err, HasSubstr("--sigma-a"));
  const Answer r = run({"plan", files.rig(), "--fast", "--sigma-s-prime", "0.8", "1.25",
                        "--sigma-a", "0.002", "0.01", "--out", files.out()});
  EXPECT_EQ(r.status, 0) << r.err;
  const Json plan = Json::parse(slurp(files.out() + "/plan.json"));
  EXPECT_EQ(plan["assumes"]["materials"], "given range");
  for (const Json& f : plan["forecast"]) {
    EXPECT_NEAR(f["sigma_s_prime_per_mm"]["expected"].get<double>(), 1.0, 1e-12);
    EXPECT_NEAR(f["sigma_a_per_mm"]["expected"].get<double>(), 0.006, 1e-12);
    ASSERT_EQ(f["corners"].size(), 4U);
    // The larger sigma_a is, the better it is known in relation.
    const auto relative = [](const Json& c) {
      return c["sigma_a_per_mm"]["std"].get<double>() /
             c["sigma_a_per_mm"]["expected"].get<double>();
    };
    EXPECT_GT(relative(f["corners"][0]), relative(f["corners"][1]));
  }
  for (const std::vector<std::string>& range :
       {std::vector<std::string>{"0", "1"}, {"2", "1"}, {"1", "nan"}}) {
    const Answer bad = run(
        {"plan", files.rig(), "--sigma-s-prime", range[0], range[1], "--sigma-a", "0.001", "0.01"});
    EXPECT_EQ(bad.status, 2);
    EXPECT_THAT(bad.err, HasSubstr("--sigma-s-prime"));
  }
}

// Ten times too long clips, thirty times too short is dark; what is suggested is neither.
TEST(Plan, ExposureAdvice) {
  const auto advised = [](double exposure_s) {
    Rig rig = body_rig("cube", 1);
    rig.scene.camera.exposure_s = exposure_s;
    PlanOptions options;
    options.suggested_shots = false;

    return plan(rig, bodies_scenes(rig), options);
  };
  const Plan chosen = [] {
    const Rig rig = body_rig("cube", 1);
    PlanOptions options;
    options.suggested_shots = false;

    return plan(rig, bodies_scenes(rig), options);
  }();
  ASSERT_EQ(chosen.exposures.size(), 3U);
  const double right_s = chosen.exposures[0].exposure_s[0];
  EXPECT_TRUE(chosen.exposures[0].chosen);
  EXPECT_EQ(chosen.exposures[1].advice, "");
  const Plan bright = advised(10.0 * right_s);
  EXPECT_TRUE(bright.any_refused());
  EXPECT_GT(bright.exposures[1].clipped_share, 0.1);
  EXPECT_THAT(bright.exposures[1].advice, HasSubstr("clipped"));
  const Plan dark = advised(right_s / 30.0);
  EXPECT_EQ(dark.exposures[1].clipped_share, 0.0);
  EXPECT_THAT(dark.exposures[1].advice, HasSubstr("of the range"));
  for (const Plan* p : {&bright, &dark}) {
    ASSERT_FALSE(p->exposures[1].suggested_s.empty());
    EXPECT_NEAR(p->exposures[1].suggested_s[0] / right_s, 1.0, 0.2);
  }
}

// A rig of a real camera is planned as if the camera needed no correction, as well known as stated.
TEST(Plan, RadianceCalibrationWithoutItsCamera) {
  Rig rig = body_rig("cube", 1);
  auto radiance = std::make_shared<capture::RadianceCalibration>();
  capture::RadianceCorrection& c = radiance->correction;
  c.width_px = rig.scene.camera.intrinsics.width_px;
  c.height_px = rig.scene.camera.intrinsics.height_px;
  c.iso = 400;
  c.f_number = 4.0;
  c.black_counts.fill(128.0);
  c.black_std_counts = 0.5;
  c.noise.fill({3.0, 2.0});
  c.glare_share.fill(0.02);
  c.vignetting = vignetting_of_frame(c.width_px, c.height_px);
  for (auto& terms : c.vignetting.radial) terms = {-0.4};
  c.shutter_relative_std = 0.003;
  rig.decoding.radiance = radiance;
  PlanOptions options;
  options.suggested_shots = false;

  const ObjectScenes scenes = bodies_scenes(rig);
  const Plan made = plan(rig, scenes, options);
  EXPECT_TRUE(made.neutral_camera);
  EXPECT_TRUE(made.calibrated_noise);
  EXPECT_EQ(made.noise[0].gain_e_per_count, 3.0);
  EXPECT_FALSE(made.any_refused());
  const std::vector<BudgetLine>& budget = made.channels[0].result.estimate.budget;
  for (const char* cause : {"black level", "exposure time"}) {
    EXPECT_TRUE(std::any_of(budget.begin(), budget.end(), [&](const BudgetLine& line) {
      return line.cause == cause;
    })) << cause;
  }
  // A camera that has what is corrected stays as it is.
  rig.truth.sensor.veiling_glare = 0.02;
  EXPECT_EQ(planned_rig(rig).decoding.radiance, rig.decoding.radiance);
}

TEST(ShadowCard, TakesAboutHalfTheLight) {
  const Rig rig = body_rig("cube", 1);
  const ObjectScenes scenes = bodies_scenes(rig);
  const ObjectScene& cube = scenes.at("cube");
  const PatchMesh patches(cube.mesh(), 1.0);
  const Led& led = rig.scene.lights[0].led()->led;
  const auto power = [&](const RayScene& shadows) {
    double sum = 0.0;
    for (const double p : illuminate(patches, shadows, led, 1.4).patch_power_sr) sum += p;
    return sum;
  };
  for (const bool upright : {true, false}) {
    const auto card = with_shadow_card(cube, led.position_mm, upright);
    ASSERT_NE(card, nullptr);
    EXPECT_EQ(mesh_problem(card->mesh()), "");
    const double share = power(*card) / power(*cube.rays);
    EXPECT_GT(share, 0.25);
    EXPECT_LT(share, 0.75);
  }
  EXPECT_EQ(with_shadow_card(cube, {0, 0, 30}, true), nullptr);
}

}  // namespace
}  // namespace scattermeter::apps
