#include <cmath>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/fixtures/apps/bracket_rig.h"
#include "tests/fixtures/apps/made_checked_rig.h"

namespace scattermeter::apps {
namespace {

using Json = nlohmann::json;

using CheckedBracket = BracketRig;

// The long shutter time is off by 6 %, as the third of a stop that is stated as 1/4 s is: `check`
// sees the merged shot, and says which file disagrees.
TEST_F(CheckedBracket, FindsATimeThatIsOff) {
  list("[short.dng, long.dng]", "[0.02, 0.25]");
  const auto report = [&] {
    const Answer r = run({"check", rig_.shots(), "--rig", rig_.rig(), "--out", rig_.out()});
    EXPECT_LE(r.status, 1) << r.err;
    return Json::parse(slurp(rig_.out() + "/check.json"));
  };
  const auto item = [](const Json& of_report, const std::string& what) {
    for (const Json& one : of_report["checks"]) {
      if (one["check"] == what) return one;
    }
    ADD_FAILURE() << "no line " << what << " in\n" << of_report;
    return Json();
  };
  rig_.simulate();
  const Json good = report();
  EXPECT_EQ(item(good, "bracket")["verdict"], "pass");
  EXPECT_EQ(item(good, "clipped")["worst"], 0.0);
  rig_.write(replaced(rig_.text(), "truth:\n",
                      "truth:\n  sensor: {exposures: [{stated_s: 0.25, true_s: 0.265}]}\n"));
  rig_.simulate();
  const Json off = item(report(), "bracket");
  EXPECT_EQ(off["verdict"], "fail");
  EXPECT_NEAR(std::abs(off["worst"].get<double>()), 6.0, 0.5);
}

TEST(CheckBracket, EachFileAgainstTheOthers) {
  MadeCheckedRig made(2);
  EXPECT_TRUE(check_bracket(made.checked).empty());
  ShotExposure first, second;
  first.file = "first.dng";
  second.file = "second.dng";
  first.departure = {std::log(0.98), 0.001, 1000.0};
  second.departure = {std::log(1.02), 0.003, 500.0};
  second.black_std_counts = 0.0;
  made.checked.shots[0].exposures = {first};  // of one file there is nothing to say
  EXPECT_TRUE(check_bracket(made.checked).empty());
  made.checked.shots[1].exposures = {first, second};
  const std::vector<CheckItem> items = check_bracket(made.checked);
  ASSERT_EQ(items.size(), 1U);
  ASSERT_EQ(items[0].details.size(), 2U);
  EXPECT_NEAR(items[0].details[0].value, -2.0, 1e-9);
  EXPECT_EQ(items[0].details[1].where, "second.dng");
  EXPECT_NEAR(items[0].details[1].value, 2.0, 1e-9);
  // Black may have moved by half the read noise of 2 counts, of 500: 0.2 %; and 0.3 % of noise.
  EXPECT_NEAR(items[0].details[1].std, std::hypot(0.2, 0.3), 1e-9);
  // 2 % are more than the limit of 1 % and more than five deviations.
  EXPECT_FALSE(items[0].passed);
  made.checked.shots[1].exposures[0].departure.noise_std = 0.005;
  made.checked.shots[1].exposures[1].departure.noise_std = 0.005;
  EXPECT_TRUE(check_bracket(made.checked)[0].passed);
  // Nothing to hold it against.
  made.checked.shots[1].exposures[1].departure.log_ratio = std::nan("");
  EXPECT_EQ(check_bracket(made.checked)[0].details.size(), 1U);
}

}  // namespace
}  // namespace scattermeter::apps
