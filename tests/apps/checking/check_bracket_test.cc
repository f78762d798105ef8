#include <cmath>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/fixtures/apps/bracket_rig.h"

namespace scattermeter::apps {
namespace {

using Json = nlohmann::json;

using CheckBracket = BracketRig;

// The long shutter time is off by 6 %, as the third of a stop that is stated as 1/4 s is: `check`
// sees the merged shot, and says which file disagrees.
TEST_F(CheckBracket, FindsATimeThatIsOff) {
  list("[short.dng, long.dng]", "[0.02, 0.25]");
  const auto item_of = [&](const std::string& what) {
    const Answer r = run({"check", rig_.shots(), "--rig", rig_.rig(), "--out", rig_.out()});
    EXPECT_LE(r.status, 1) << r.err;
    const Json report = Json::parse(slurp(rig_.out() + "/check.json"));
    for (const Json& item : report["checks"]) {
      if (item["check"] == what) return item;
    }
    ADD_FAILURE() << "no line " << what << " in\n" << r.out;
    return Json();
  };
  rig_.simulate();
  EXPECT_EQ(item_of("bracket")["verdict"], "pass");
  EXPECT_EQ(item_of("clipped")["worst"], 0.0);
  rig_.write(replaced(rig_.text(), "truth:\n",
                      "truth:\n  sensor: {exposures: [{stated_s: 0.25, true_s: 0.265}]}\n"));
  rig_.simulate();
  const Json off = item_of("bracket");
  EXPECT_EQ(off["verdict"], "fail");
  EXPECT_NEAR(std::abs(off["worst"].get<double>()), 6.0, 0.5);
}

}  // namespace
}  // namespace scattermeter::apps
