#include "apps/rig/led_calibration_file.h"

#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "apps/rig/rig_light_reader.h"
#include "tests/fixtures/apps/yaml_text.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

// With digits that a shorter text would lose.
calib::LedCalibration made_led_calibration() {
  calib::LedCalibration c;
  c.light = "led1";
  c.shots.responsivity = {2.4e10 / 3.0, 2.9e10 / 3.0, 2.1e10 / 3.0};
  c.shots.highlight_names = {"s.dng sphere 1", "s.dng sphere 2"};
  c.shots.scene.highlights.resize(2);
  c.shots.scene.highlights[0].image_px = {100.25, 50.5};
  c.shots.grids = {{"p.dng", 0, 4, 3}};
  calib::LedFit& fit = c.fit;
  fit.status = calib::LedStatus::kOk;
  fit.lobe_fitted = true;
  fit.led.position_mm = {30.0 + 1.0 / 3.0, -60.0 / 7.0, 80.1};
  fit.led.axis = {0, 0, -1};
  fit.led.exponent = 4.0 / 3.0;
  fit.led.radius_mm = 0.1;
  fit.led.intensity_W_per_sr = {0.05 / 3.0, 0.0, 0.04 / 7.0};
  fit.uncertainty.tangents = {Eigen::Vector3d::UnitY(), -Eigen::Vector3d::UnitX()};
  for (Eigen::Index i = 0; i < kLedParameters; ++i) {
    const auto x = static_cast<double>(i + 1);
    fit.uncertainty.covariance(i, i) = 0.01 * x;
    fit.uncertainty.common[i] = i < kLedLogIntensity ? 0.0 : 0.005;
  }
  fit.uncertainty.covariance(0, 2) = fit.uncertainty.covariance(2, 0) = -0.01 / 3.0;
  fit.uncertainty.covariance(2, 6) = fit.uncertainty.covariance(6, 2) = 0.001;
  fit.distance_mm = 95.5;
  fit.highlight_residuals_px = {{0.1, -0.2}, {3.0, 4.0}};
  fit.highlight_used = {true, false};
  fit.highlight_rms_px = 0.224;
  fit.plane_rms = 0.01;
  fit.warnings = {"a warning: with a colon"};
  return c;
}

class LedCalibrationFile : public ::testing::Test {
 protected:
  CalibratedLed read(const std::string& text) const {
    write_file(folder_ / "led.yaml", text);
    return read_led_calibration_file(folder_ / "led.yaml");
  }
  // What is said of the good file with one text replaced.
  std::string refused(const std::string& from, const std::string& to) const {
    std::string text = led_calibration_yaml(made_led_calibration());
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from << " is not in\n" << text;
    return refusal_of([&] { read(text.replace(at, from.size(), to)); });
  }
  TemporaryFolder folder_;
};

TEST_F(LedCalibrationFile, ReadsBackToTheLastDigit) {
  const calib::LedCalibration c = made_led_calibration();
  const CalibratedLed read_back = read(led_calibration_yaml(c));
  EXPECT_EQ(read_back.led.position_mm, c.fit.led.position_mm);
  EXPECT_EQ(read_back.led.axis, c.fit.led.axis);
  EXPECT_EQ(read_back.led.exponent, c.fit.led.exponent);
  EXPECT_EQ(read_back.led.radius_mm, c.fit.led.radius_mm);
  EXPECT_TRUE((read_back.led.intensity_W_per_sr == c.fit.led.intensity_W_per_sr).all());
  EXPECT_EQ(read_back.responsivity, c.shots.responsivity);
  EXPECT_EQ(read_back.uncertainty.tangents[0], c.fit.uncertainty.tangents[0]);
  EXPECT_EQ(read_back.uncertainty.tangents[1], c.fit.uncertainty.tangents[1]);
  EXPECT_EQ(read_back.uncertainty.covariance, c.fit.uncertainty.covariance);
  EXPECT_EQ(read_back.uncertainty.common, c.fit.uncertainty.common);
}

// Without a white plane, the intensities are the rig's: no responsivity goes with them.
TEST_F(LedCalibrationFile, BySpheresAloneHasNoResponsivity) {
  calib::LedCalibration c = made_led_calibration();
  c.fit.lobe_fitted = false;
  EXPECT_FALSE(read(led_calibration_yaml(c)).responsivity.has_value());
  // Files of earlier versions have one all the same, but the power depends on nothing.
  c.fit.lobe_fitted = true;
  c.fit.uncertainty.covariance(2, 6) = c.fit.uncertainty.covariance(6, 2) = 0.0;
  EXPECT_FALSE(read(led_calibration_yaml(c)).responsivity.has_value());
}

// A fit may correct a table to both sides.
TEST_F(LedCalibrationFile, HoldsATabulatedLobe) {
  calib::LedCalibration c = made_led_calibration();
  c.fit.led.exponent = -0.125;
  using Values = std::vector<double>;
  for (const LobeTable& table :
       {LobeTable({0.0, 1.0, 1.25}, {1.0, 0.25, 0.0}),
        LobeTable({-1.0, 0.0, 1.25}, Values{0, 1, 0}, Values{0.0, 1.0, 0.0}, {1, 2, 0})}) {
    c.fit.led.table = std::make_shared<LobeTable>(table);
    const CalibratedLed read_back = read(led_calibration_yaml(c));
    ASSERT_NE(read_back.led.table, nullptr);
    ASSERT_EQ(read_back.led.table->angles_rad().size(), table.angles_rad().size());
    EXPECT_NEAR(read_back.led.table->angles_rad().back(), 1.25, 1e-15);
    EXPECT_EQ(read_back.led.table->in_x(), table.in_x());
    EXPECT_EQ(read_back.led.table->in_y(), table.in_y());
    EXPECT_NEAR((read_back.led.table->x_axis() - table.x_axis()).norm(), 0.0, 1e-15);
    EXPECT_EQ(read_back.led.exponent, -0.125);
  }
}

// For people, and for plots: what the fit left.
TEST_F(LedCalibrationFile, HoldsTheResiduals) {
  calib::LedCalibration c = made_led_calibration();
  c.fit.ambient = {{0, {}, {0.01, 0.02, 0.03}, {0.001, 0.002, 0.003}}};
  const YamlField top = yaml_text(led_calibration_yaml(c));
  EXPECT_EQ(top.at("light").text(), "led1");
  EXPECT_EQ(top.at("distance_mm").number(), 95.5);
  const YamlField residuals = top.at("residuals");
  EXPECT_EQ(residuals.at("highlight_rms_px").number(), 0.224);
  EXPECT_EQ(residuals.at("plane_rms_percent").number(), 1.0);
  const YamlField second = residuals.at("highlights").items().at(1);
  EXPECT_EQ(second.at("what").text(), "s.dng sphere 2");
  EXPECT_EQ(second.at("used").text(), "false");
  EXPECT_EQ(second.at("predicted_minus_measured_px").numbers(2), (std::vector<double>{3, 4}));
  const YamlField ambient = top.at("ambient").items().at(0);
  EXPECT_EQ(ambient.at("file").text(), "p.dng");
  EXPECT_EQ(ambient.at("relative").numbers(3), (std::vector<double>{0.01, 0.02, 0.03}));
  EXPECT_EQ(ambient.at("relative_std").numbers(3), (std::vector<double>{0.001, 0.002, 0.003}));
  EXPECT_EQ(top.at("warnings").items().at(0).text(), "a warning: with a colon");
  EXPECT_NO_THROW(read(led_calibration_yaml(c)));
}

TEST_F(LedCalibrationFile, ARefusedFitIsNotWritten) {
  calib::LedCalibration c = made_led_calibration();
  c.fit.status = calib::LedStatus::kMisfit;
  EXPECT_THROW(led_calibration_yaml(c), std::invalid_argument);
}

TEST_F(LedCalibrationFile, NamesWhatIsWrong) {
  EXPECT_EQ(refused("led1", "led2"), "");
  EXPECT_THAT(refused("scattermeter_led: 1", "scattermeter_led: 2"), HasSubstr("version 1"));
  EXPECT_THAT(refused("exponent: 1.3", "exponent: -1.3"), HasSubstr("exponent"));
  EXPECT_THAT(refused("light:", "colour: red\nlight:"), HasSubstr("colour: unknown key"));
  // The axis no longer stands on its tangents.
  EXPECT_THAT(refused("axis: [0, 0, -1]", "axis: [0, 0.01, -1]"),
              HasSubstr("axis_tangents: expected directions at right angles"));
}

TEST_F(LedCalibrationFile, RefusesWhatIsNoCovariance) {
  const auto refused_covariance = [&](const std::function<void(LedUncertainty&)>& spoil) {
    calib::LedCalibration c = made_led_calibration();
    spoil(c.fit.uncertainty);
    return refusal_of([&] { read(led_calibration_yaml(c)); });
  };
  const std::string message = "covariance: expected a covariance: symmetric";
  EXPECT_THAT(refused_covariance([](auto& u) { u.covariance(0, 2) = 0.0; }), HasSubstr(message));
  EXPECT_THAT(refused_covariance([](auto& u) { u.covariance(4, 4) = -0.05; }), HasSubstr(message));
  // A correlation above 1: variances 0.01 and 0.03.
  EXPECT_THAT(refused_covariance([](auto& u) { u.covariance(0, 2) = u.covariance(2, 0) = 0.018; }),
              HasSubstr(message));
  EXPECT_EQ(refused_covariance([](auto& u) { u.covariance(0, 2) = u.covariance(2, 0) = 0.017; }),
            "");
  // What is common to a plane's LEDs is part of the covariance: 0.07 = 0.2646^2.
  EXPECT_THAT(refused_covariance([](auto& u) { u.common[6] = 0.265; }), HasSubstr(message));
  EXPECT_EQ(refused_covariance([](auto& u) {
              u.common.setZero();
              u.common[6] = 0.264;
            }),
            "");
}

// A light of the rig takes it; where no plane was seen, the responsivity stays the rig's.
TEST_F(LedCalibrationFile, IsALight) {
  calib::LedCalibration c = made_led_calibration();
  const auto as_light = [&] {
    write_file(folder_ / "led.yaml", led_calibration_yaml(c));
    return read_light("led1", yaml_text("l: {type: led, calibration: led.yaml}").at("l"),
                      folder_ / "rig.yaml", {});
  };
  const SceneLight light = as_light();
  EXPECT_EQ(light.files, std::vector<std::string>{folder_ / "led.yaml"});
  EXPECT_EQ(light.led()->led.position_mm, c.fit.led.position_mm);
  ASSERT_TRUE(light.led()->calibrated.has_value());
  EXPECT_EQ(light.led()->calibrated->covariance, c.fit.uncertainty.covariance);
  EXPECT_EQ(light.led()->calibrated_for, c.shots.responsivity);
  EXPECT_EQ(light.led()->radiance_corrected, false);
  c.radiance_corrected = true;
  EXPECT_EQ(as_light().led()->radiance_corrected, true);
  c.fit.lobe_fitted = false;
  EXPECT_FALSE(as_light().led()->calibrated_for.has_value());
  EXPECT_FALSE(as_light().led()->radiance_corrected.has_value());
}

}  // namespace
}  // namespace scattermeter::apps
