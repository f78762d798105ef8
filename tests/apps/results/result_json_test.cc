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
}

}  // namespace
}  // namespace scattermeter::apps
