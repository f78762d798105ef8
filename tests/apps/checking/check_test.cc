// Rigs that no longer hold, each found and named.
#include <map>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/fixtures/apps/html_check.h"
#include "tests/fixtures/apps/small_rig.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::json;

struct Checked {
  Answer answer;
  std::map<std::string, Json> items;  // by name
  std::string verdict(const std::string& what) const { return items.at(what)["verdict"]; }
  std::string where(const std::string& what) const { return items.at(what)["worst_at"]; }
};

Checked check(const SmallRig& rig) {
  Checked out;
  out.answer = run({"check", rig.shots(), "--rig", rig.rig(), "--out", rig.out()});
  if (out.answer.status == 2) return out;
  const Json json = Json::parse(slurp(rig.out() + "/check.json"));
  for (const Json& item : json["checks"]) out.items[item["check"]] = item;
  return out;
}

// Shoots the shots whose line holds the text again, with the rig's text changed.
void reshoot(SmallRig& rig, const std::string& holding, const std::string& from,
             const std::string& to) {
  const std::string before = rig.text();
  rig.write(replaced(before, from, to));
  rig.keep_shots(holding);
  rig.simulate();
  rig.write(before);
}

void exchange(const SmallRig& rig, const std::string& a, const std::string& b) {
  const std::string of_a = slurp(rig.shots() + "/" + a);
  const std::string of_b = slurp(rig.shots() + "/" + b);
  write_file(rig.shots() + "/" + a, of_b);
  write_file(rig.shots() + "/" + b, of_a);
}

TEST(Check, AGoodRigPasses) {
  SmallRig rig;
  rig.keep_shots("POM_");
  rig.simulate();
  const Checked c = check(rig);
  EXPECT_EQ(c.answer.status, 0) << c.answer.out << c.answer.err;
  // Of one material, two things have nothing to be held against.
  for (const auto& [what, item] : c.items) {
    const bool judged = what != "LED drift" && what != "material in shot";
    EXPECT_EQ(item["verdict"], judged ? "pass" : "not judged") << what;
  }
  EXPECT_THAT(c.answer.out, HasSubstr("all "));
  const std::string page = slurp(rig.out() + "/check.html");
  EXPECT_EQ(html_problem(page), "");
  EXPECT_LT(page.size(), 5'000'000U);
  EXPECT_THAT(page, HasSubstr("POM_pyramid_2.dng"));
}

TEST(Check, ALightLeftOn) {
  SmallRig rig;
  rig.keep_shots("PE_");
  rig.simulate();
  // In one shot.
  const std::string before = rig.text();
  rig.write(replaced(before, "lights:\n  led1:",
                     "lights:\n  lamp: {type: ambient, radiance_W_per_mm2_sr: [1.5e-7, 1.5e-7, "
                     "1.5e-7], radiance_std_W_per_mm2_sr: [0, 0, 0]}\n  led1:"));
  reshoot(rig, "PE_cube_2", "cube, material: PE, lights: [led2]",
          "cube, material: PE, lights: [led2, lamp]");
  rig.write(before);
  const Checked c = check(rig);
  EXPECT_EQ(c.answer.status, 1) << c.answer.out;
  EXPECT_EQ(c.verdict("light from elsewhere"), "fail") << c.answer.out;
  EXPECT_THAT(c.where("light from elsewhere"), HasSubstr("PE_cube_2.dng"));
}

// The camera wrote it down.
TEST(Check, ApertureAndIsoChanged) {
  SmallRig rig;
  rig.keep_shots("POM_cube");
  rig.simulate();
  reshoot(rig, "POM_cube_2", "  exposure_s: 0.05\n",
          "  exposure_s: 0.05\n  f_number: 5.6\n  iso: 200\n");
  const Checked c = check(rig);
  EXPECT_EQ(c.answer.status, 1);
  EXPECT_EQ(c.verdict("aperture"), "fail");
  EXPECT_EQ(c.verdict("ISO setting"), "fail");
}

// A lens without contacts: only the light tells. A third of a stop.
TEST(Check, ApertureChangedUnseen) {
  SmallRig rig;
  rig.keep_shots("POM_");
  rig.simulate();
  reshoot(rig, "POM_pyramid_1", "[2.4e10, 2.9e10, 2.1e10]", "[1.9e10, 2.3e10, 1.67e10]");
  const Checked c = check(rig);
  EXPECT_EQ(c.answer.status, 1);
  EXPECT_EQ(c.verdict("aperture"), "pass");
  EXPECT_EQ(c.verdict("light of shot"), "fail") << c.answer.out;
  EXPECT_THAT(c.where("light of shot"), HasSubstr("POM_pyramid_1.dng"));
}

TEST(Check, OneClippedChannel) {
  SmallRig rig;
  rig.keep_shots("POM_cube");
  rig.simulate();
  reshoot(rig, "POM_cube_1",
          "axis: [-30, 60, -70], exponent: 1, intensity_W_per_sr: [0.05, 0.05, 0.05]",
          "axis: [-30, 60, -70], exponent: 1, intensity_W_per_sr: [0.05, 0.15, 0.05]");
  const Checked c = check(rig);
  EXPECT_EQ(c.answer.status, 1);
  EXPECT_EQ(c.verdict("clipped"), "fail") << c.answer.out;
  EXPECT_EQ(c.where("clipped"), "POM_cube_1.dng G");
  EXPECT_THAT(c.answer.out, HasSubstr("expose shorter"));
}

TEST(Check, AnLedThatWasOff) {
  SmallRig rig;
  rig.keep_shots("PP_");
  rig.simulate();
  reshoot(rig, "PP_pyramid_2",
          "axis: [70, 20, -50], exponent: 1, intensity_W_per_sr: [0.05, 0.05, 0.05]",
          "axis: [70, 20, -50], exponent: 1, intensity_W_per_sr: [1e-9, 1e-9, 1e-9]");
  const Checked c = check(rig);
  EXPECT_EQ(c.answer.status, 1);
  EXPECT_EQ(c.verdict("brightest patch"), "fail") << c.answer.out;
  EXPECT_THAT(c.where("brightest patch"), HasSubstr("PP_pyramid_2.dng"));
  EXPECT_THAT(c.answer.out, HasSubstr("whether the LED was on"));
  // The others are judged all the same.
  EXPECT_EQ(c.verdict("light of shot"), "pass");
}

TEST(Check, LightsExchanged) {
  SmallRig rig;
  rig.keep_shots("PE_");
  rig.simulate();
  exchange(rig, "PE_cube_1.dng", "PE_cube_2.dng");
  const Checked c = check(rig);
  EXPECT_EQ(c.answer.status, 1);
  EXPECT_EQ(c.verdict("light in shot"), "fail") << c.answer.out;
  EXPECT_THAT(c.where("light in shot"), HasSubstr("PE_cube_"));
  EXPECT_THAT(c.where("light in shot"), HasSubstr("lit by led"));
}

TEST(Check, ObjectsExchanged) {
  SmallRig rig;
  rig.keep_shots("PE_");
  rig.simulate();
  exchange(rig, "PE_cube_1.dng", "PE_pyramid_1.dng");
  const Checked c = check(rig);
  EXPECT_EQ(c.answer.status, 1);
  EXPECT_EQ(c.verdict("light in shot"), "fail") << c.answer.out;
  EXPECT_THAT(c.where("light in shot"), HasSubstr("of object"));
}

TEST(Check, MaterialsExchanged) {
  SmallRig rig;
  rig.keep_shots("_cube_");
  rig.simulate();
  exchange(rig, "PP_cube_1.dng", "POM_cube_1.dng");
  const Checked c = check(rig);
  EXPECT_EQ(c.answer.status, 1);
  EXPECT_EQ(c.verdict("material in shot"), "fail") << c.answer.out;
  EXPECT_EQ(c.where("material in shot"), "PP_cube_1.dng and POM_cube_1.dng");
}

TEST(Check, AnLedThatMovedByTwoMillimetres) {
  SmallRig rig;
  rig.keep_shots("PE_");
  rig.simulate();
  rig.write(replaced(rig.text(), "position_mm: [30, -60, 80]", "position_mm: [32, -60, 80]"));
  const Checked c = check(rig);
  EXPECT_EQ(c.answer.status, 1);
  EXPECT_EQ(c.verdict("LED place"), "fail") << c.answer.out;
  EXPECT_EQ(c.where("LED place"), "led1 along x");
  EXPECT_NEAR(c.items.at("LED place")["worst"].get<double>(), -2.0, 0.5);
}

// Names from the rig stay text.
TEST(Check, PagesEscapeNames) {
  SmallRig rig;
  rig.keep_shots("PE_cube");
  std::string text = rig.text();
  for (std::size_t at = 0; (at = text.find("material: PE", at)) != std::string::npos;) {
    text.replace(at, 12, "material: \"<script>x</script>&\"");
    at += 20;
  }
  rig.write(replaced(text, "    PE: {", "    \"<script>x</script>&\": {"));
  rig.simulate();
  EXPECT_EQ(check(rig).answer.status, 0);
  EXPECT_EQ(rig.measure().status, 0);
  for (const char* name : {"/check.html", "/result.html"}) {
    const std::string page = slurp(rig.out() + name);
    EXPECT_EQ(html_problem(page), "") << name;
    EXPECT_THAT(page, HasSubstr("&lt;script&gt;x&lt;/script&gt;&amp;")) << name;
    EXPECT_THAT(page, Not(HasSubstr("<script"))) << name;
  }
  EXPECT_THAT(slurp(rig.out() + "/result.html"), HasSubstr("data:image/svg+xml"));
}

}  // namespace
}  // namespace scattermeter::apps
