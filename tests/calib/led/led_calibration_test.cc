#include "calib/led/led_calibration.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

#include <Eigen/Cholesky>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <oneapi/tbb/parallel_for.h>

#include "apps/instrument/calibration_inputs.h"
#include "apps/pages/led_plots.h"
#include "apps/report/calibration_tables.h"
#include "apps/rig/led_calibration_file.h"
#include "apps/simulation/virtual_led_shots.h"
#include "calib/led/led_check.h"
#include "core/base/input_error.h"
#include "core/view/camera_view.h"
#include "tests/fixtures/apps/led_rig.h"
#include "tests/fixtures/apps/small_rig.h"
#include "tests/fixtures/draws.h"
#include "tests/fixtures/temporary_folder.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

const std::string kWrongLed =
    "{type: led, position_mm: [42, -70, 92], axis: [-30, 60, -70], exponent: 1, radius_mm: 2, "
    "intensity_W_per_sr: [1, 1, 1]}";

std::string write_rig(const TemporaryFolder& folder, const std::string& name,
                      const LedRigText& text) {
  const std::string path = folder / name;
  std::ofstream(path) << led_rig_yaml(text);
  return path;
}

class LedCalibrationTest : public ::testing::Test {
 protected:
  LedCalibrationTest() {
    truth_ = read_rig(write_rig(folder_, "truth.yaml", {}));
    LedRigText wrong;
    wrong.led = kWrongLed;
    wrong_ = read_rig(write_rig(folder_, "wrong.yaml", wrong));
  }

  calib::LedFrames frames(const VirtualLedShots& shots, std::uint64_t seed) const {
    return [&shots, seed](std::size_t i) { return shots.frame(i, seed); };
  }

  TemporaryFolder folder_;
  Rig truth_, wrong_;
};

LedVector off_truth(const calib::LedFit& fit, const Led& truth) {
  LedVector d;
  d.head<3>() = fit.led.position_mm - truth.position_mm;
  for (Eigen::Index t = 0; t < 2; ++t) {
    d[3 + t] = -fit.uncertainty.tangents[static_cast<std::size_t>(t)].dot(truth.axis);
  }
  d[5] = fit.led.exponent - truth.exponent;
  for (Eigen::Index c = 0; c < 3; ++c) {
    d[6 + c] = std::log(fit.led.intensity_W_per_sr[c] / truth.intensity_W_per_sr[c]);
  }
  return d;
}

using LedCalibrationStatistics = LedCalibrationTest;

// Raws of one truth; marks, spheres and albedo are believed to be a little else than they are.
TEST_F(LedCalibrationStatistics, IsUnbiasedAndAsUncertainAsItSays) {
  const int n = test_support::draws(12, 50);
  const auto seeds = static_cast<std::size_t>(n);
  const VirtualLedShots shots(truth_, true);
  std::vector<LedVector> off(seeds);
  std::vector<LedMatrix> covariance(seeds);
  std::vector<std::string> problem(seeds);
  tbb::parallel_for(std::size_t{0}, seeds, [&](std::size_t s) {
    Rig told = wrong_;
    std::mt19937_64 generator(s + 1);
    std::normal_distribution<double> normal;
    for (PointPair& pair : told.pose.points) {
      for (int k = 0; k < 2; ++k) pair.image_px[k] += 0.05 * normal(generator);
    }
    for (calib::MirrorSphere& sphere : told.calibration.led->spheres) {
      for (int k = 0; k < 3; ++k) sphere.center_mm[k] += 0.006 * normal(generator);
    }
    const double whiter = 1.0 + 0.005 * normal(generator);
    for (calib::WhitePlane& plane : told.calibration.led->planes) plane.albedo /= whiter;
    const calib::LedCalibration c =
        calib::calibrate_led(led_calibration_input(told), "led1", frames(shots, s + 1));
    problem[s] = c.fit.message;
    off[s] = off_truth(c.fit, truth_.scene.light("led1").led()->led);
    covariance[s] = c.fit.uncertainty.covariance;
  });
  LedVector mean = LedVector::Zero(), square = mean, predicted = mean;
  double worst_mm = 0.0;
  for (std::size_t s = 0; s < seeds; ++s) {
    ASSERT_EQ(problem[s], "");
    mean += off[s] / n;
    square += off[s].cwiseAbs2() / n;
    predicted += covariance[s].diagonal() / n;
    worst_mm = std::max(worst_mm, off[s].head<3>().norm());
  }
  double log_ratio = 0.0;
  for (Eigen::Index k = 0; k < 9; ++k) {
    const double sampled = std::sqrt((square[k] - mean[k] * mean[k]) * n / (n - 1.0));
    const double ratio = std::sqrt(predicted[k]) / sampled;
    log_ratio += std::log(ratio) / 9.0;
    EXPECT_LT(std::abs(mean[k]), 3.5 * sampled / std::sqrt(n)) << k;
    // 50 draws know a deviation to 10 %: three of those for each, the stated 20 % for their mean.
    EXPECT_NEAR(ratio, 1.0, test_support::limit_at(0.35, 50, n)) << k;
    std::printf("parameter %td: mean %+.3g off, sampled %.3g, predicted/sampled %.2f\n", k, mean[k],
                sampled, ratio);
  }
  std::printf("LED position: %.3f mm off at worst\n", worst_mm);
  EXPECT_NEAR(std::exp(log_ratio), 1.0, test_support::limit_at(0.2, 50, n));
  EXPECT_LT(worst_mm, 0.2);
  EXPECT_LT(3.0 * std::sqrt(predicted[5]), 0.02 * 1.3);
}

TEST_F(LedCalibrationTest, StandsDustShadowsSaturationAndAHiddenSphere) {
  Rig truth = truth_;
  truth.calibration.led->shots[0].exposure_s = 8.0 * VirtualLedShots(truth_, true).exposure_s(0);
  VirtualLedShots shots(truth, true);
  // The third sphere is covered; the low plane has specks and a shadow.
  std::vector<float>& spheres = shots.counts(0);
  const Eigen::Vector2d hidden =
      project(truth.scene.camera.intrinsics, look_at({0, -100, 150}, {0, 0, 5}, {0, 0, 1}),
              {{-22, 16, 10}})
          .front();
  std::vector<float>& plane = shots.counts(1);
  for (int y = 0; y < 324; ++y) {
    for (int x = 0; x < 484; ++x) {
      const auto at = static_cast<std::size_t>(y * 484 + x);
      if ((Eigen::Vector2d(x, y) - hidden).norm() < 70.0) spheres[at] = 0.0F;
      if (x % 37 < 2 && y % 29 < 2) plane[at] *= 0.5F;
      if (x > 240 && x < 300 && y > 100 && y < 160) plane[at] *= 0.4F;
    }
  }
  const calib::LedCalibration c =
      calib::calibrate_led(led_calibration_input(wrong_), "led1", frames(shots, 1));
  ASSERT_EQ(c.fit.status, calib::LedStatus::kOk) << c.fit.message;
  ASSERT_EQ(c.shots.notes.size(), 1U);
  EXPECT_THAT(c.shots.notes[0], HasSubstr("spheres_led1.dng sphere 3: no highlight"));
  EXPECT_EQ(c.shots.scene.highlights.size(), 3U);
  const LedVector d = off_truth(c.fit, truth_.scene.light("led1").led()->led);
  EXPECT_LT(d.head<3>().norm(), 0.2);
  EXPECT_LT(std::abs(d[5]), 0.02 * 1.3);
  EXPECT_LT(std::count(c.fit.cell_used.begin(), c.fit.cell_used.end(), true),
            static_cast<std::ptrdiff_t>(c.fit.cell_used.size()));
}

TEST_F(LedCalibrationTest, CheckFindsAMovedLed) {
  const VirtualLedShots shots(truth_, true);
  const calib::LedCheck same =
      calib::check_led(led_calibration_input(truth_), "led1", frames(shots, 2));
  EXPECT_EQ(same.problem, "");
  EXPECT_LT(same.displacement_stds, 4.0);
  EXPECT_LT(same.highlight_worst_px, 0.1);
  EXPECT_LT(same.plane_rms_percent, 0.3);
  EXPECT_LT(same.power_change_percent.abs().maxCoeff(), 0.2);
  Rig moved = truth_;
  moved.scene.lights[0].led()->led.position_mm += Eigen::Vector3d(1.2, -1.2, 1.06);  // 2 mm
  moved.scene.lights[0].led()->position_std_mm = 0.2;
  const calib::LedCheck found =
      calib::check_led(led_calibration_input(moved), "led1", frames(shots, 2));
  EXPECT_EQ(found.problem, "");
  EXPECT_NEAR(found.displacement_length_mm, 2.0, 0.2);
  EXPECT_GT(found.displacement_stds, 5.0);
  EXPECT_GT(found.displacement_length_mm, 5.0 * found.displacement_std_mm);
  EXPECT_THAT(found.text, HasSubstr("led1 is "));
  EXPECT_GT(found.highlight_rms_px, 5.0 * same.highlight_rms_px);
  EXPECT_GT(found.plane_rms_percent, 2.0 * same.plane_rms_percent);
  ASSERT_EQ(found.maps.size(), 2U);
  EXPECT_EQ(found.maps[0].percent.size(),
            static_cast<std::size_t>(found.maps[0].columns * found.maps[0].rows));
}

// The LED's own irradiance in the middle of the low plane is 3.9e-6 W/mm^2 in G.
const std::string kAmbientTruth =
    "truth:\n  ambient_irradiance_W_per_mm2: [1.7e-7, 1.9e-7, 1.6e-7]\n";

TEST_F(LedCalibrationTest, StandsAmbientLightSubtractedOrFitted) {
  LedRigText text;
  text.truth = kAmbientTruth;
  const Rig lit = read_rig(write_rig(folder_, "lit.yaml", text));
  const VirtualLedShots lit_shots(lit, true);
  text.shots += "      - {file: low_off.dng, kind: ambient, plane: 1}\n";
  text.shots += "      - {file: high_off.dng, kind: ambient, plane: 2}\n";
  const Rig dark = read_rig(write_rig(folder_, "off.yaml", text));
  const VirtualLedShots dark_shots(dark, true);
  ASSERT_EQ(dark_shots.size(), 5U);
  EXPECT_EQ(dark_shots.exposure_s(3), dark_shots.exposure_s(1));
  const auto told = [&](const Rig& rig, calib::AmbientModel model) {
    Rig out = wrong_;
    out.calibration.led = rig.calibration.led;
    out.calibration.led->ambient = model;
    return out;
  };
  const Led& truth = truth_.scene.light("led1").led()->led;
  const auto stds_off = [&](const calib::LedFit& fit) {
    const Eigen::Vector3d d = fit.led.position_mm - truth.position_mm;
    const Eigen::Matrix3d c = fit.uncertainty.covariance.topLeftCorner<3, 3>();
    return std::sqrt(d.dot(c.ldlt().solve(d)));
  };
  // Three dimensions: beyond 4.5 deviations once in 7000.
  const calib::LedCalibration subtracted =
      calib::calibrate_led(led_calibration_input(told(dark, calib::AmbientModel::kWhereSeen)),
                           "led1", frames(dark_shots, 1));
  ASSERT_EQ(subtracted.fit.status, calib::LedStatus::kOk) << subtracted.fit.message;
  EXPECT_TRUE(subtracted.fit.ambient.empty());
  EXPECT_LT(stds_off(subtracted.fit), 4.5);
  EXPECT_LT((subtracted.fit.led.position_mm - truth.position_mm).norm(), 0.2);
  const calib::LedCalibration fitted =
      calib::calibrate_led(led_calibration_input(told(lit, calib::AmbientModel::kWhereSeen)),
                           "led1", frames(lit_shots, 1));
  ASSERT_EQ(fitted.fit.status, calib::LedStatus::kOk) << fitted.fit.message;
  ASSERT_EQ(fitted.fit.ambient.size(), 2U);
  EXPECT_LT(stds_off(fitted.fit), 4.5);
  EXPECT_THAT(led_calibration_table(fitted), HasSubstr("ambient light of low_led1.dng: R"));
  EXPECT_THAT(led_calibration_yaml(fitted), HasSubstr("ambient:"));
  // What it costs shows.
  EXPECT_GT(fitted.fit.uncertainty.covariance(kLedExponent, kLedExponent),
            subtracted.fit.uncertainty.covariance(kLedExponent, kLedExponent));
  const calib::LedCalibration blind = calib::calibrate_led(
      led_calibration_input(told(lit, calib::AmbientModel::kNone)), "led1", frames(lit_shots, 1));
  EXPECT_GT(blind.fit.plane_inflation, 4.0);
  EXPECT_FALSE(blind.fit.warnings.empty());
  RecordProperty("subtracted_stds", std::to_string(stds_off(subtracted.fit)));
  RecordProperty("fitted_stds", std::to_string(stds_off(fitted.fit)));
  RecordProperty("blind_stds", std::to_string(stds_off(blind.fit)));
  for (const auto& [name, fit] :
       {std::pair{"subtracted", &subtracted.fit}, {"fitted", &fitted.fit}, {"blind", &blind.fit}}) {
    RecordProperty(std::string(name) + "_mm",
                   std::to_string((fit->led.position_mm - truth.position_mm).norm()));
    RecordProperty(std::string(name) + "_exponent", std::to_string(fit->led.exponent));
  }
  // check says so; of a plane that was shot with the LED off, there is nothing to say.
  const calib::LedCheck seen =
      calib::check_led(led_calibration_input(lit), "led1", frames(lit_shots, 2));
  EXPECT_NEAR(seen.ambient_percent, 4.5, 2.0);
  EXPECT_GT(seen.ambient_percent, 5.0 * seen.ambient_std_percent);
  EXPECT_NE(seen.ambient_file, "");
  const calib::LedCheck clean =
      calib::check_led(led_calibration_input(dark), "led1", frames(dark_shots, 2));
  EXPECT_EQ(clean.ambient_percent, 0.0);
  ASSERT_EQ(clean.maps.size(), 2U);
  ASSERT_EQ(clean.maps[0].std_percent.size(), clean.maps[0].percent.size());
  const std::vector<PagePlot> plots = led_plane_plots({clean});
  ASSERT_EQ(plots.size(), 4U);
  EXPECT_THAT(plots[0].caption, HasSubstr("low_led1.dng under led1"));
  EXPECT_EQ(plots[0].plot.colours.full_scale, plots[1].plot.colours.full_scale);
  EXPECT_EQ(plots[0].plot.series[0].value.size(), clean.maps[0].percent.size());
}

TEST_F(LedCalibrationTest, CommandsMakeAFileThatARigTakes) {
  const std::string shots = folder_ / "shots";
  ASSERT_EQ(
      run({"simulate", truth_.path, "--out", shots, "--what", "calibration", "--quiet"}).status, 0);
  const std::string out = folder_ / "cal";
  const Answer made = run({"calibrate", "led", shots, "--rig", wrong_.path, "--out", out});
  ASSERT_EQ(made.status, 0) << made.err;
  EXPECT_THAT(made.out, HasSubstr("position x"));
  const CalibratedLed read = read_led_calibration_file(out + "/led1.yaml");
  EXPECT_LT((read.led.position_mm - truth_.scene.light("led1").led()->led.position_mm).norm(), 0.2);
  EXPECT_EQ(read.led.radius_mm, 2.0);

  LedRigText text;
  text.led = "{type: led, calibration: cal/led1.yaml}";
  const Rig rig = read_rig(write_rig(folder_, "calibrated.yaml", text));
  ASSERT_TRUE(rig.scene.lights[0].led()->calibrated);
  EXPECT_EQ(rig.scene.lights[0].led()->led.position_mm, read.led.position_mm);
  // As it came, to the last digit.
  const calib::LedCalibration again =
      calib::calibrate_led(led_calibration_input(wrong_), "led1", led_frames_in(wrong_, shots));
  EXPECT_EQ(again.fit.led.position_mm, read.led.position_mm);
  EXPECT_EQ(again.fit.uncertainty.covariance, read.uncertainty.covariance);
  EXPECT_EQ(again.fit.uncertainty.common, read.uncertainty.common);
}

TEST_F(LedCalibrationTest, RefusesWhatIsUndetermined) {
  LedRigText text;
  text.led = kWrongLed;
  text.shots = "\n      - {file: spheres_led1.dng, kind: spheres, light: led1}\n";
  Rig rig = read_rig(write_rig(folder_, "one.yaml", text));
  rig.calibration.led->spheres.resize(1);
  const VirtualLedShots shots(truth_, true);
  const calib::LedCalibration c =
      calib::calibrate_led(led_calibration_input(rig), "led1", frames(shots, 1));
  EXPECT_EQ(c.fit.status, calib::LedStatus::kTooFewData);
  EXPECT_THAT(led_calibration_table(c), HasSubstr("refused"));
  EXPECT_THROW(led_calibration_yaml(c), std::invalid_argument);
}

std::string first_replaced(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), by);
}

TEST_F(LedCalibrationTest, BadInputIsNamed) {
  const std::string good = led_rig_yaml();
  const auto error = [&](const std::string& text) -> std::string {
    const std::string path = folder_ / "bad.yaml";
    std::ofstream(path) << text;
    try {
      read_rig(path);
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_THAT(error(first_replaced(good, "radius_mm: 8", "radius_mm: -8")), HasSubstr("-8"));
  EXPECT_THAT(error(first_replaced(good, "albedo: [0.9", "albedo: [1.9")), HasSubstr("at most 1"));
  EXPECT_THAT(error(first_replaced(good, "plane: 2,", "plane: 3,")), HasSubstr("plane"));
  EXPECT_THAT(error(first_replaced(good, "plane: 2,", "")), HasSubstr("several planes"));
  EXPECT_THAT(error(first_replaced(good, "kind: spheres", "kind: balls")), HasSubstr("balls"));
  const std::string off = "kind: ambient, plane: 1}";
  const std::string spheres = "kind: spheres, light: led1}";
  EXPECT_THAT(error(first_replaced(good, spheres, "kind: ambient, plane: 1, light: led1}")),
              HasSubstr("every LED is off"));
  EXPECT_THAT(error(first_replaced(good, spheres, off + "\n      - {file: off2.dng, " + off)),
              HasSubstr("two ambient shots"));
  EXPECT_THAT(error(first_replaced(good, spheres, "kind: ambient}")), HasSubstr("several planes"));
  LedRigText model;
  model.more = "    ambient: some\n";
  EXPECT_THAT(error(led_rig_yaml(model)), HasSubstr("some"));
  EXPECT_THAT(error(good + "truth: {ambient_irradiance_W_per_mm2: [1, -1, 1]}\n"),
              HasSubstr("ambient_irradiance_W_per_mm2"));
  EXPECT_THAT(error(first_replaced(good, "low_led1.dng", "high_led1.dng")), HasSubstr("same name"));
  EXPECT_THAT(error(first_replaced(good, "{type: led, ", "{type: led, calibration: x.yaml, ")),
              HasSubstr("given twice"));
  LedRigText text;
  text.led = "{type: led, calibration: missing.yaml}";
  EXPECT_THAT(error(led_rig_yaml(text)), HasSubstr("missing.yaml"));

  const VirtualLedShots shots(truth_, true);
  EXPECT_THROW(calib::calibrate_led(led_calibration_input(truth_), "led9", frames(shots, 1)),
               InputError);
  Rig other = truth_;
  other.calibration.led->shots[0].light = "led9";
  EXPECT_THROW(calib::calibrate_led(led_calibration_input(other), "led9", frames(shots, 1)),
               InputError);
  const Answer none = run({"calibrate", "led", folder_ / "nowhere", "--rig", truth_.path, "--light",
                           "led1", "--out", folder_ / "x.yaml"});
  EXPECT_EQ(none.status, 2);
  EXPECT_THAT(none.err, HasSubstr("spheres_led1.dng"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "x.yaml"));

  // A file that is no covariance.
  const calib::LedCalibration c =
      calib::calibrate_led(led_calibration_input(wrong_), "led1", frames(shots, 1));
  const std::string yaml = led_calibration_yaml(c);
  const auto file_error = [&](const std::string& content) -> std::string {
    const std::string path = folder_ / "led.yaml";
    std::ofstream(path) << content;
    try {
      read_led_calibration_file(path);
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_EQ(file_error(yaml), "");
  EXPECT_THAT(file_error(first_replaced(yaml, "  - [", "  - [7")), HasSubstr("axis_tangents"));
  calib::LedCalibration negative = c;
  negative.fit.uncertainty.common[0] = 9.0;
  EXPECT_THAT(file_error(led_calibration_yaml(negative)), HasSubstr("covariance"));
  EXPECT_THAT(file_error(first_replaced(yaml, "exponent: ", "exponent: -")), HasSubstr("exponent"));
  EXPECT_THAT(file_error(first_replaced(yaml, "scattermeter_led: 1", "scattermeter_led: 2")),
              HasSubstr("version"));
}

}  // namespace
}  // namespace scattermeter::apps
