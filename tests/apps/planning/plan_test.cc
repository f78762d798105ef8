#include "apps/planning/plan.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include <gtest/gtest.h>

#include "apps/bench/bench_plan.h"
#include "capture/sensor/radiance_calibration.h"
#include "tests/fixtures/apps/body_rig.h"
#include "tests/fixtures/apps/made_plan.h"

namespace scattermeter::apps {
namespace {

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
      EXPECT_EQ(row.planned, row.measured)
          << i << row.channel << ::testing::PrintToString(row.reasons);
      EXPECT_TRUE(row.planned) << i << row.channel;
      EXPECT_NEAR(std::log(row.forecast_sigma_s_prime / row.stated_sigma_s_prime), 0.0,
                  std::log(1.25))
          << i << row.channel;
      EXPECT_NEAR(std::log(row.forecast_sigma_a / row.stated_sigma_a), 0.0, std::log(1.25))
          << i << row.channel;
    }
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

TEST(Plan, PercentAsText) {
  EXPECT_EQ(percent_text(0.0251), "2.5 %");
  EXPECT_EQ(percent_text(0.0994), "9.9 %");
  EXPECT_EQ(percent_text(0.0996), "10 %");
  EXPECT_EQ(percent_text(1.234), "123 %");
  EXPECT_EQ(percent_text(std::nan("")), "–");
  EXPECT_EQ(percent_text(RelativeRange{0.02, 0.035}), "2 … 3.5 %");
  EXPECT_EQ(percent_text(RelativeRange{0.02, 0.0201}), "2 %");
}

// Over the expected medium and the corners, without those that give no estimate.
TEST(Plan, RelativeRangeAndRefusals) {
  Plan made = made_plan();
  PlannedChannel& red = made.channels[0];
  Forecast corner = red.expected;
  corner.estimate.sigma_a_per_mm = normal_quantity(0.02, 0.002);
  Forecast none = corner;
  none.estimate.converged = false;
  none.estimate.sigma_a_per_mm.std = 1e-6;
  red.corners = {corner, none};
  EXPECT_NEAR(relative_range(red, &Estimate::sigma_a_per_mm).low, 0.1, 1e-12);
  EXPECT_NEAR(relative_range(red, &Estimate::sigma_a_per_mm).high, 0.5, 1e-12);
  EXPECT_TRUE(std::isnan(relative_range(made.channels[1], &Estimate::sigma_a_per_mm).low));
  EXPECT_TRUE(made.any_refused());  // green
  made.channels.pop_back();
  EXPECT_FALSE(made.any_refused());
  red.corners[0].estimate.reasons = {"too dark"};
  EXPECT_TRUE(made.any_refused());
}

}  // namespace
}  // namespace scattermeter::apps
