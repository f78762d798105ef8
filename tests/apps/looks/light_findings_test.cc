// LightLook::findings()
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "apps/looks/light_look.h"
#include "tests/fixtures/apps/lit_shots.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

class LightFindings : public ::testing::Test {
 protected:
  std::vector<Finding> findings() {
    return LightLook(lit_.rig.scene, *lit_.lit, lit_.shots, lit_.weights).findings();
  }
  void scale_light(std::size_t light, double factor) {
    lit_.rig.scene.lights[light].led()->led.intensity_W_per_sr *= factor;
  }
  LitShots lit_{"cube"};
};

TEST_F(LightFindings, GoodRig) {
  for (const Finding& f : findings()) ADD_FAILURE() << f.text;
}

TEST_F(LightFindings, LedsExchanged) {
  std::swap(lit_.shots[0].observation, lit_.shots[1].observation);
  const auto found = findings();
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found[0].cause, "LEDs exchanged");
  EXPECT_EQ(found[0].shots.size(), 2U);
}

TEST_F(LightFindings, OneFileExchanged) {
  lit_.shots[0].observation = lit_.shots[1].observation;
  const auto found = findings();
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found[0].cause, "file exchanged");
  EXPECT_THAT(found[0].text, HasSubstr("plastic_cube_1.dng looks lit by led2"));
  EXPECT_EQ(found[0].shots, std::vector<std::size_t>{0});
}

TEST_F(LightFindings, MilliwattsForWatts) {
  scale_light(0, 1000);
  scale_light(1, 1000);
  const auto found = findings();
  ASSERT_EQ(found.size(), 1U);
  EXPECT_THAT(found[0].text, HasSubstr("mW for W"));
  EXPECT_THAT(found[0].text, HasSubstr("the shots contain 1000 times less"));
  // One of them alone.
  scale_light(0, 1e-3);
  EXPECT_THAT(findings().at(0).text, HasSubstr("lit by led2"));
}

// What an LED shows that was off, but for some light from elsewhere.
TEST_F(LightFindings, AnLedThatWasOff) {
  scale_light(1, 300);
  const auto found = findings();
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].cause, "light off by a factor");
  EXPECT_THAT(found[0].advice, HasSubstr("see that they were on"));
}

// In red, the LEDs are stated at a twentieth of what they are.
TEST_F(LightFindings, OneChannelOffByAFactor) {
  for (SceneLight& light : lit_.rig.scene.lights) light.led()->led.intensity_W_per_sr[0] /= 20.0;
  const auto found = findings();
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].cause, "light off by a factor");
  EXPECT_THAT(found[0].text, HasSubstr("more light in R than"));
  EXPECT_EQ(found[0].shots.size(), 2U);
}

// Red LEDs say nothing about the other channels.
TEST_F(LightFindings, NoPowerInAChannel) {
  for (SceneLight& light : lit_.rig.scene.lights) light.led()->led.intensity_W_per_sr[2] = 0.0;
  for (const Finding& f : findings()) ADD_FAILURE() << f.text;
}

// A free scale says nothing about units; a factor of two is left to the fit.
TEST_F(LightFindings, FactorsThatAreAllowed) {
  scale_light(0, 2);
  scale_light(1, 2);
  EXPECT_TRUE(findings().empty());
  scale_light(0, 500);
  scale_light(1, 500);
  lit_.rig.scene.camera.responsivity.reset();
  EXPECT_TRUE(findings().empty());
}

// Half of the picture shows nothing of the object. Where a round one stands its outline does not
// show.
TEST(LightFindingsOfCoveredObjects, NameWhatElseMayBe) {
  for (const char* body : {"cube", "sphere"}) {
    LitShots lit(body);
    ObservedShot& shot = lit.shots[0];
    for (ChannelObservation& o : shot.observation.channel) {
      for (std::size_t j = 0; j < o.l.size(); ++j) {
        if (shot.seen->map.samples[j].mean_mm.x() > 0) o.l[j] *= 1e-3;
      }
    }
    const auto found = LightLook(lit.rig.scene, *lit.lit, lit.shots, lit.weights).findings();
    ASSERT_EQ(found.size(), 1U) << body;
    EXPECT_EQ(found[0].cause, "object covered");
    EXPECT_EQ(found[0].text.find("not where or as large as its mesh") != std::string::npos,
              std::string(body) == "sphere")
        << found[0].text;
    EXPECT_EQ(found[0].shots, std::vector<std::size_t>{0});
  }
}

// True transport instead of the dipole: the looks leave a good rig alone.
TEST(LightFindingsOfTransport, GoodRig) {
  LitShots lit("cube", true);
  for (const Finding& f : LightLook(lit.rig.scene, *lit.lit, lit.shots, lit.weights).findings()) {
    ADD_FAILURE() << f.text;
  }
}

// A red material, which is nearly black in blue.
TEST(LightFindingsOfTransport, ColouredMaterial) {
  for (const double sigma_a_per_mm : {1.0, 5.0}) {
    LitShots lit("cube", true, Medium{1.5, sigma_a_per_mm, 1.0});
    for (const Finding& f : LightLook(lit.rig.scene, *lit.lit, lit.shots, lit.weights).findings()) {
      ADD_FAILURE() << sigma_a_per_mm << ": " << f.text;
    }
  }
}

}  // namespace
}  // namespace scattermeter::apps
