#include "apps/report/result_table.h"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "apps/results/result_json.h"
#include "core/base/input_error.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

Measurement two_channels() {
  Measurement m;
  ChannelResult good;
  good.material = "POM";
  good.channel = 'R';
  good.eta_int_over_ext = 1.48;
  good.shots = {"a.dng"};
  ChannelResult bad = good;
  bad.channel = 'G';
  good.estimate.converged = true;
  good.estimate.sigma_s_prime_per_mm = {2.1934, 0.0123, 2.17, 2.22};
  good.estimate.sigma_a_per_mm = {0.002013, 0.000045, 0.0019, 0.0021};
  good.estimate.rms_relative = 0.0123;
  good.estimate.psnr_db = std::numeric_limits<double>::infinity();
  bad.estimate.reasons = {"a.dng: channel G is dark"};
  m.results = {good, bad};
  m.timing_s = {{"total", 1.5}};
  m.inputs = {{"rig.yaml", "00ff"}};
  return m;
}

TEST(ResultTable, ShowsValuesWithTheirDeviationsDigits) {
  const std::string table = result_table(two_channels());
  EXPECT_THAT(table, HasSubstr("2.193 ± 0.012"));
  EXPECT_THAT(table, HasSubstr("0.002013 ± 0.000045"));
  EXPECT_THAT(table, HasSubstr("1.23 %"));
  EXPECT_THAT(table, HasSubstr("refused: POM G: a.dng: channel G is dark"));
}

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
