#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/fixtures/apps/html_check.h"
#include "tests/fixtures/apps/small_rig.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::json;

// The forecast is made of the causes that result.json then has, line by line.
TEST(PlanCommand, FilesHoldTheForecast) {
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

TEST(PlanCommand, RangeInPlaceOfTruth) {
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

}  // namespace
}  // namespace scattermeter::apps
