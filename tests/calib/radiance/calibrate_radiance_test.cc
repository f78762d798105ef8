#include "calib/radiance/calibrate_radiance.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "apps/instrument/calibration_inputs.h"
#include "apps/report/calibration_tables.h"
#include "apps/report/radiance_plots.h"
#include "apps/rig/radiance_file.h"
#include "capture/sensor/virtual_sensor.h"
#include "core/base/input_error.h"
#include "tests/fixtures/apps/radiance_rig.h"
#include "tests/fixtures/temporary_folder.h"

namespace scattermeter::apps {
namespace {

class CalibrateRadiance : public ::testing::Test {
 protected:
  CalibrateRadiance() : rig_(radiance_rig()) {}

  std::string refusal(
      const std::function<void(const calib::RadianceShot&, capture::RawFrame&)>& spoil,
      const Rig& told) {
    const RadianceShots shots(rig_, true);
    try {
      calib::calibrate_radiance(radiance_calibration_input(told),
                                [&](const calib::RadianceShot& s) {
                                  capture::RawFrame frame = shots.frame(s, 1);
                                  spoil(s, frame);
                                  return frame;
                                });
    } catch (const InputError& e) {
      return e.what();
    }
    return "accepted";
  }

  Rig rig_;
};

TEST_F(CalibrateRadiance, FindsTheHotPixels) {
  const capture::RadianceCalibration c = calibrated(rig_, rig_, 3);
  const capture::RawFrame quiet = capture::VirtualSensor(rig_.scene, rig_.truth.sensor, false)
                                      .frame(std::vector<float>(9600, 0.0F), 2.0, 1);
  std::vector<std::size_t> truth;
  for (std::size_t i = 0; i < quiet.samples.size(); ++i) {
    if (quiet.samples[i] > 64 + 6 + 20) truth.push_back(i);
  }
  EXPECT_FALSE(truth.empty());
  EXPECT_EQ(c.correction.defect_pixels, truth);
  EXPECT_NEAR(c.correction.dark_counts_per_s[0], 3.0, 0.1);
  EXPECT_TRUE(c.notes.empty()) << c.notes.front();
}

TEST_F(CalibrateRadiance, WorksWithTheLossyToneCurve) {
  rig_.scene.camera.sensor.nef_lossy_curve = true;
  const capture::RadianceCalibration c = calibrated(rig_, rig_, 3);
  EXPECT_NEAR(c.correction.noise[1].gain_e_per_count, 6.0, 5 * c.gain_std_e_per_count[1]);
  EXPECT_NEAR(c.correction.response[0].log_ratio_at(2500), true_log_ratio(rig_, 2500), 0.004);
}

TEST_F(CalibrateRadiance, FileComesBack) {
  const capture::RadianceCalibration c = calibrated(rig_, rig_, 3);
  const TemporaryFolder folder;
  write_file(folder / "r.yaml", radiance_file_text(c));
  const capture::RadianceCalibration read = read_radiance_file(folder / "r.yaml");
  EXPECT_EQ(radiance_file_text(read), radiance_file_text(c));
  EXPECT_EQ(read.correction.defect_pixels, c.correction.defect_pixels);
  // The points lie about the curve that was fitted to them.
  ASSERT_GT(read.linearity.size(), 3U);
  const Plot plot = linearity_plot(read);
  ASSERT_EQ(plot.series.size(), 4U);
  for (const capture::RadiancePoint& p : read.linearity) {
    const double curve = std::expm1(-c.correction.response[0].log_ratio_at(p.counts));
    EXPECT_NEAR(p.value, curve, 0.002 + 5.0 * p.std) << p.counts;
  }
  for (std::size_t k = 0; k < kRgb; ++k) {
    EXPECT_GT(read.noise[k].size(), 3U);
    EXPECT_EQ(photon_transfer_plot(read, k).series.size(), 2U);
  }
  EXPECT_NE(radiance_calibration_table(c).find("gain R"), std::string::npos);
  std::string other = radiance_file_text(c);
  other.replace(other.find(": 1"), 3, ": 2");
  write_file(folder / "r.yaml", other);
  EXPECT_THROW(read_radiance_file(folder / "r.yaml"), InputError);
}

TEST_F(CalibrateRadiance, RefusesDarkFramesWithLight) {
  const auto add = [](double counts, bool one_side) {
    return [=](const calib::RadianceShot& s, capture::RawFrame& f) {
      if (s.file != "dark3.dng") return;
      for (std::size_t i = 0; i < f.samples.size(); ++i) {
        const double share = one_side ? static_cast<double>(i % 120) / 60.0 : 1.0;
        f.samples[i] = static_cast<std::uint16_t>(f.samples[i] + counts * share);
      }
    };
  };
  for (const auto& [counts, side] :
       {std::pair{300.0, false}, {300.0, true}, {3.0, true}, {8.0, false}}) {
    const std::string what = refusal(add(counts, side), rig_);
    EXPECT_NE(what.find("dark3.dng"), std::string::npos) << what;
    EXPECT_NE(what.find("light"), std::string::npos) << what;
  }
}

TEST_F(CalibrateRadiance, RefusesAnotherIsoOrAperture) {
  std::string what = refusal(
      [](const calib::RadianceShot& s, capture::RawFrame& f) {
        if (s.file == "dark2.dng") f.iso = 400;
      },
      rig_);
  EXPECT_NE(what.find("dark2.dng: ISO 400"), std::string::npos) << what;
  what = refusal(
      [](const calib::RadianceShot& s, capture::RawFrame& f) {
        if (s.file.starts_with("white")) f.f_number = 5.6;
      },
      rig_);
  EXPECT_NE(what.find("f/5.6"), std::string::npos) << what;
}

TEST_F(CalibrateRadiance, RefusesFlatsThatAreClippedOrDark) {
  Rig bright = rig_;
  for (double& l : *rig_.calibration.radiance->flat_radiance_W_per_mm2_sr) l *= 3;
  std::string what = refusal([](const calib::RadianceShot&, capture::RawFrame&) {}, bright);
  EXPECT_NE(what.find("clipped"), std::string::npos) << what;
  for (double& l : *rig_.calibration.radiance->flat_radiance_W_per_mm2_sr) l *= 1e-4;
  what = refusal([](const calib::RadianceShot&, capture::RawFrame&) {}, bright);
  EXPECT_NE(what.find("expose longer"), std::string::npos) << what;
}

TEST_F(CalibrateRadiance, NeedsPairsAndThreeTimes) {
  const auto nothing = [](const calib::RadianceShot&, capture::RawFrame&) {};
  Rig told = rig_;
  std::vector<calib::RadianceShot>& flats = told.calibration.radiance->flats;
  // One frame of one pair is missing: said, not refused.
  flats.erase(flats.begin() + 3);
  EXPECT_EQ(refusal(nothing, told), "accepted");
  const capture::RadianceCalibration c = calibrated(told, rig_, 1);
  ASSERT_EQ(c.notes.size(), 1U);
  EXPECT_NE(c.notes[0].find("0.008 s has no partner"), std::string::npos) << c.notes[0];
  // No pair at all.
  std::vector<calib::RadianceShot> singles;
  for (std::size_t i = 0; i < 12; i += 2) {
    singles.push_back(rig_.calibration.radiance->flats[i]);
  }
  flats = singles;
  EXPECT_NE(refusal(nothing, told).find("no two flats of equal exposure"), std::string::npos);
  // One exposure only.
  flats = {rig_.calibration.radiance->flats[4], rig_.calibration.radiance->flats[5]};
  EXPECT_NE(refusal(nothing, told).find("1 exposure time"), std::string::npos);
  // The same file twice: no noise in the difference.
  EXPECT_NE(refusal(
                [&](const calib::RadianceShot& s, capture::RawFrame& f) {
                  if (s.file.starts_with("flat")) {
                    for (auto& v : f.samples) v = static_cast<std::uint16_t>(500);
                  }
                },
                rig_)
                .find("does not grow"),
            std::string::npos);
}

TEST_F(CalibrateRadiance, RefusesTrapsOutOfTheFrameAndPlanesOutOfView) {
  const auto nothing = [](const calib::RadianceShot&, capture::RawFrame&) {};
  Rig told = rig_;
  told.calibration.radiance->glare->traps_px[0].x0 = 110;
  EXPECT_NE(refusal(nothing, told).find("leaves the frame"), std::string::npos);
  told = rig_;
  told.calibration.radiance->glare->traps_px[0] = {45, 25, 20, 20};  // on the bright patch
  EXPECT_NE(refusal(nothing, told).find("the trap at [45, 25]"), std::string::npos);
  told = rig_;
  told.calibration.radiance->white->plane.origin_mm = {500, 0, 0};
  EXPECT_NE(refusal(nothing, told).find("pixels"), std::string::npos);
}

}  // namespace
}  // namespace scattermeter::apps
