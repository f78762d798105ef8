#include "apps/results/result_json.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/fixtures/apps/made_measurement.h"

namespace scattermeter::apps {
namespace {

TEST(ResultJson, HoldsTheContractsFields) {
  const nlohmann::json j =
      nlohmann::json::parse(result_json(two_channels(), "scattermeter measure x"));
  const nlohmann::json& r = j["results"][0];
  for (const char* key :
       {"material", "channel", "model", "eta", "sigma_s_prime_per_mm", "sigma_a_per_mm",
        "correlation", "scale", "verdict", "reasons", "residual", "shots"}) {
    EXPECT_TRUE(r.contains(key)) << key;
  }
  EXPECT_EQ(r["sigma_a_per_mm"]["std"], 0.000045);
  EXPECT_EQ(r["sigma_s_prime_per_mm"]["interval95"][1], 2.22);
  EXPECT_EQ(r["verdict"], "ok");
  EXPECT_TRUE(r["residual"]["psnr_db"].is_null());  // not finite
  EXPECT_EQ(j["results"][1]["verdict"], "refused");
  EXPECT_TRUE(j["results"][1]["sigma_a_per_mm"]["value"].is_null());
  EXPECT_EQ(j["inputs"][0]["sha256"], "00ff");
  EXPECT_EQ(j["timing_s"]["total"], 1.5);
  EXPECT_EQ(j["command"], "scattermeter measure x");
  EXPECT_TRUE(j["version"].is_string());
  EXPECT_EQ(j["$schema"], kResultSchema);
}

TEST(ResultJson, EveryNumberOfAChannel) {
  Measurement m = two_channels();
  ChannelResult& r = m.results[0];
  r.model = "transport";
  r.estimate.correlation = -0.25;
  r.estimate.budget = {{"noise", 0.01, 0.00002}};
  r.estimate.pulls = {{"led1.power", "LED power", 1.5, 0.03, 0.02, 0.01, 0, 9.0, -0.2, 0.0004}};
  r.estimate.scale = {1.01, 0.02, 0.97, 1.05};
  r.estimate.reduced_chi2 = 1.5;
  r.estimate.rows = 77;
  r.patches_by_state[static_cast<std::size_t>(RowState::kClipped)] = 3;
  r.patches_by_state[static_cast<std::size_t>(RowState::kOutlier)] = 4;
  r.patches_partly_seen = 5;
  r.singles.resize(1);
  r.singles[0].file = "a.dng";
  r.singles[0].estimate = r.estimate;
  r.agreement = {3.5, 2, 0.17};
  r.dipole = r.estimate;
  r.dipole->sigma_s_prime_per_mm.value = 2.3;
  r.why_transport = "the body is no half-space";
  m.brackets = {{"a.dng", {{"b.dng", 0.25, {1, 2, 3}, {0.01, 0.002, 100}}}, {4, 5, 6}, {7, 8, 9}}};
  m.patch_size_mm = {{"cube", 0.4}};
  m.skipped.patches_unlit = 11;
  const nlohmann::json j = nlohmann::json::parse(result_json(m));
  const nlohmann::json& c = j["results"][0];
  EXPECT_EQ(c["correlation"], -0.25);
  EXPECT_EQ(c["budget"][0]["sigma_a_per_mm"], 0.00002);
  EXPECT_EQ(c["pulls"][0]["quantity"], "led1.power");
  EXPECT_EQ(c["pulls"][0]["pull"], 1.5);
  EXPECT_EQ(c["pulls"][0]["least_seen_in_std"], 9.0);
  EXPECT_EQ(c["pulls"][0]["unseen"]["sigma_s_prime_per_mm"], -0.2);
  EXPECT_EQ(c["pulls"][0]["unseen"]["sigma_a_per_mm"], 0.0004);
  EXPECT_EQ(c["rests_on"][0], "LED power");
  EXPECT_EQ(c["scale"]["interval95"][0], 0.97);
  EXPECT_EQ(c["residual"]["reduced_chi2"], 1.5);
  EXPECT_EQ(c["residual"]["rms_relative"], 0.0123);
  EXPECT_EQ(c["patches"], 77);
  EXPECT_EQ(c["patches_left_out"]["clipped"], 3);
  EXPECT_EQ(c["patches_left_out"]["outlier"], 4);
  EXPECT_EQ(c["patches_left_out"]["silhouette_or_crease"], 5);
  EXPECT_EQ(c["agreement"]["degrees_of_freedom"], 2);
  EXPECT_EQ(c["agreement"]["p_value"], 0.17);
  EXPECT_EQ(c["agreement"]["shots"][0]["shot"], "a.dng");
  EXPECT_EQ(c["agreement"]["shots"][0]["sigma_s_prime_per_mm"]["value"], 2.1934);
  EXPECT_EQ(c["dipole"]["sigma_s_prime_per_mm"]["value"], 2.3);
  EXPECT_NEAR(c["dipole"]["sigma_s_prime_off_relative"].get<double>(), 2.3 / 2.1934 - 1.0, 1e-12);
  EXPECT_EQ(c["why_transport"], "the body is no half-space");
  EXPECT_EQ(j["brackets"][0]["files"][0]["exposure_s"], 0.25);
  EXPECT_EQ(j["brackets"][0]["files"][0]["samples"]["B"], 3);
  EXPECT_EQ(j["brackets"][0]["files"][0]["log_light_over_others"], 0.01);
  EXPECT_EQ(j["brackets"][0]["samples"]["R"], 4);
  EXPECT_EQ(j["brackets"][0]["samples_clipped_in_all"]["G"], 8);
  EXPECT_EQ(j["patch_size_mm"]["cube"], 0.4);
  EXPECT_EQ(j["skipped"]["patches_not_lit"], 11);
  EXPECT_EQ(j["command"], "");
}

}  // namespace
}  // namespace scattermeter::apps
