#include "apps/rig/rig_led_agreement.h"

#include <array>
#include <memory>
#include <optional>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capture/sensor/radiance_calibration.h"
#include "tests/fixtures/apps/yaml_text.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

class RigLedAgreement : public ::testing::Test {
 protected:
  LedLight& add_led(const std::string& name) {
    SceneLight light;
    light.name = name;
    light.kind.emplace<LedLight>();
    rig_.scene.lights.push_back(light);
    return *rig_.scene.lights.back().led();
  }

  Rig rig_;
  YamlField lights_ = yaml_text("a: {calibration: a.yaml}\nb: {calibration: b.yaml}");
};

TEST_F(RigLedAgreement, TheShotsAreCorrectedAsThoseOfTheLedsWere) {
  LedLight& led = add_led("a");
  const auto refusal = [&] { return refusal_of([&] { require_radiance_of_leds(rig_); }); };
  EXPECT_EQ(refusal(), "");  // a file that does not say
  led.radiance_corrected = true;
  EXPECT_THAT(refusal(), HasSubstr("lights.a.calibration: was made of shots that camera.radiance"));
  rig_.decoding.radiance = std::make_shared<capture::RadianceCalibration>();
  EXPECT_EQ(refusal(), "");
  led.radiance_corrected = false;
  EXPECT_THAT(refusal(), HasSubstr("lights.a.calibration: was made without camera.radiance"));
}

TEST_F(RigLedAgreement, OneResponsivityForAll) {
  const std::array<double, 3> responsivity = {1e10, 2e10, 3e10};
  add_led("a").calibrated_for = responsivity;
  const auto refusal = [&] {
    return refusal_of([&] { take_responsivity_of_leds(lights_, rig_); });
  };
  EXPECT_EQ(refusal(), "");
  EXPECT_EQ(rig_.scene.camera.responsivity, responsivity);
  rig_.scene.camera.responsivity->at(2) = 4e10;
  EXPECT_THAT(refusal(), HasSubstr("but the camera's is"));
  rig_.scene.camera.responsivity.reset();
  add_led("b");
  EXPECT_THAT(refusal(), HasSubstr("light b has no such calibration"));
}

TEST_F(RigLedAgreement, ACopiedLedIsRefused) {
  LedLight& a = add_led("a");
  a.led.position_mm = {30, -60, 80};
  const Led same = a.led;
  LedLight& b = add_led("b");
  b.led = same;
  const auto refusal = [&] {
    return refusal_of([&] { require_different_leds(lights_, rig_.scene); });
  };
  EXPECT_THAT(refusal(), HasSubstr("has position, axis and intensity of a"));
  b.led.position_mm.x() = 31;
  EXPECT_EQ(refusal(), "");
}

}  // namespace
}  // namespace scattermeter::apps
