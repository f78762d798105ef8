#include "apps/report/plan_json.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/fixtures/apps/made_plan.h"

namespace scattermeter::apps {
namespace {

TEST(PlanJson, HoldsThePlan) {
  const nlohmann::json j = nlohmann::json::parse(plan_json(made_plan(), "scattermeter plan x"));
  ASSERT_EQ(j["forecast"].size(), 2U);
  const nlohmann::json& red = j["forecast"][0];
  EXPECT_EQ(red["material"], "POM");
  EXPECT_EQ(red["channel"], "R");
  EXPECT_EQ(red["eta"], 1.4);
  EXPECT_EQ(red["sigma_s_prime_per_mm"]["expected"], 2.0);
  EXPECT_EQ(red["sigma_s_prime_per_mm"]["std"], 0.1);
  EXPECT_EQ(red["sigma_s_prime_per_mm"]["interval95"][0], 2.0 - 1.96 * 0.1);
  EXPECT_EQ(red["sigma_a_per_mm"]["interval95"][1], 0.01 + 1.96 * 0.005);
  EXPECT_EQ(red["correlation"], 0.25);
  EXPECT_EQ(red["verdict"], "ok");
  EXPECT_EQ(red["patches"], 123);
  EXPECT_EQ(red["budget"][1]["cause"], "scale");
  EXPECT_EQ(red["budget"][1]["sigma_a_per_mm"], 0.004);
  // 0.005^2 - 0.004^2 = 0.003^2.
  ASSERT_EQ(red["known_exactly"].size(), 1U);
  EXPECT_NEAR(red["known_exactly"][0]["sigma_a_std_per_mm"].get<double>(), 0.003, 1e-12);
  EXPECT_FALSE(red.contains("corners"));
  const nlohmann::json& green = j["forecast"][1];
  EXPECT_EQ(green["verdict"], "refused");
  EXPECT_TRUE(green["sigma_a_per_mm"]["std"].is_null());
  EXPECT_EQ(green["reasons"][0], "a.dng: channel G is dark");
  EXPECT_EQ(j["assumes"]["materials"], "truth.materials");
  EXPECT_EQ(j["assumes"]["noise"], "camera.sensor");
  EXPECT_EQ(j["assumes"]["noise_model"]["B"]["read_noise_counts"], 1.25);
  ASSERT_EQ(j["exposures"].size(), 2U);
  EXPECT_EQ(j["exposures"][1]["channel"], "G");
  EXPECT_EQ(j["exposures"][1]["clipped_share"], 0.25);
  EXPECT_EQ(j["exposures"][1]["suggested_exposure_s"], nlohmann::json::array({0.01, 0.04}));
  const nlohmann::json& other = j["other_shots"][0];
  EXPECT_EQ(other["sigma_a_relative_std"], 0.5);
  EXPECT_EQ(other["coarse_over_fine"], 1.1);
  EXPECT_EQ(other["gains"][0]["with"], "one more shot");
  EXPECT_EQ(other["gains"][0]["sigma_a_std_ratio"], 0.6);
  const nlohmann::json& places = other["led_maps"][0]["places"];
  EXPECT_EQ(places[0]["one_more_shot_sigma_a_relative_std"], 0.4);
  EXPECT_TRUE(places[1]["one_shot_sigma_a_relative_std"].is_null());
  EXPECT_EQ(places[1]["position_mm"], nlohmann::json::array({100.0, 0.0, 10.0}));
  EXPECT_EQ(j["patch_size_mm"]["cube"], 0.4);
  EXPECT_EQ(j["timing_s"]["forecast"], 1.5);  // of all rounds
  EXPECT_EQ(j["command"], "scattermeter plan x");
  EXPECT_EQ(j["inputs"][0]["sha256"], "00ff");
}

TEST(PlanJson, CornersOfARange) {
  Plan plan = made_plan();
  plan.from_truth = false;
  plan.calibrated_noise = true;
  plan.channels[0].corners = {{{1.0, 0.002, 1.4}, plan.channels[0].result.estimate}};
  const nlohmann::json j = nlohmann::json::parse(plan_json(plan, ""));
  EXPECT_EQ(j["assumes"]["materials"], "given range");
  EXPECT_EQ(j["assumes"]["noise"], "camera.radiance");
  ASSERT_EQ(j["forecast"][0]["corners"].size(), 1U);
  EXPECT_EQ(j["forecast"][0]["corners"][0]["sigma_a_per_mm"]["expected"], 0.002);
}

}  // namespace
}  // namespace scattermeter::apps
