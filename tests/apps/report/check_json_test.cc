#include "apps/report/check_json.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/fixtures/apps/made_check.h"

namespace scattermeter::apps {
namespace {

TEST(CheckJson, HoldsEveryItem) {
  const nlohmann::json j = nlohmann::json::parse(check_json(made_check(), "scattermeter check x"));
  EXPECT_EQ(j["passed"], false);
  EXPECT_EQ(j["command"], "scattermeter check x");
  EXPECT_EQ(j["notes"], nlohmann::json::array({"c.dng: skipped"}));
  EXPECT_TRUE(j["version"].is_string());
  ASSERT_EQ(j["checks"].size(), 3U);
  const nlohmann::json& pose = j["checks"][0];
  EXPECT_EQ(pose["check"], "pose");
  EXPECT_EQ(pose["verdict"], "pass");
  EXPECT_EQ(pose["worst"], -0.4);
  EXPECT_EQ(pose["worst_at"], "b.dng");
  EXPECT_NEAR(pose["rms"].get<double>(), 0.35355339, 1e-8);
  EXPECT_EQ(pose["limit"], 1.0);
  EXPECT_EQ(pose["limit_is"], "most");
  EXPECT_EQ(pose["unit"], "px");
  ASSERT_EQ(pose["details"].size(), 2U);
  EXPECT_EQ(pose["details"][0]["where"], "a.dng");
  EXPECT_EQ(pose["details"][0]["value"], 0.3);
  EXPECT_TRUE(pose["details"][0]["std"].is_null());
  EXPECT_EQ(pose["details"][1]["std"], 0.01);
  EXPECT_EQ(j["checks"][1]["verdict"], "fail");
  EXPECT_EQ(j["checks"][1]["limit_is"], "least");
  EXPECT_EQ(j["checks"][1]["advice"], "expose longer");
  EXPECT_EQ(j["checks"][2]["verdict"], "not judged");
  EXPECT_TRUE(j["checks"][2]["worst"].is_null());
}

TEST(CheckJson, PassedAndBytesThatAreNoUtf8) {
  CheckReport report = made_check();
  report.items.erase(report.items.begin() + 1);
  report.notes = {"\xFC.dng"};
  const nlohmann::json j = nlohmann::json::parse(check_json(report, ""));
  EXPECT_EQ(j["passed"], true);
  EXPECT_EQ(j["notes"][0], "\xEF\xBF\xBD.dng");
}

}  // namespace
}  // namespace scattermeter::apps
