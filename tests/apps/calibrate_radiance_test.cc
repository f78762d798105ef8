#include "apps/calibrate_radiance.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>

#include <gtest/gtest.h>

#include "apps/radiance_plots.h"
#include "apps/virtual_sensor.h"
#include "core/input_error.h"
#include "tests/apps/radiance_rig.h"
#include "tests/temporary_folder.h"

namespace scattermeter::apps {
namespace {

// A quantity over many draws.
struct Draws {
  std::string name;
  double bias_limit;  // absolute
  double n = 0, sum = 0, squares = 0, predicted = 0;
  void add(double error, double std) {
    n += 1.0;
    sum += error;
    squares += error * error;
    predicted += std * std;
  }
  double bias() const { return sum / n; }
  double scatter() const { return std::sqrt(squares / n - bias() * bias()); }
  double ratio() const { return std::sqrt(predicted / n) / scatter(); }
};

// log(light / recorded) of the simulated sensor.
double true_log_ratio(const Rig& rig, double recorded) {
  double light = recorded;
  for (int i = 0; i < 60; ++i) {
    light = recorded / (1.0 + rig.truth_sensor.non_linearity * light / (4095.0 - 64.0));
  }
  return std::log(light / recorded);
}

class CalibrateRadiance : public ::testing::Test {
 protected:
  CalibrateRadiance() : rig_(radiance_rig()) {}

  std::string refusal(const std::function<void(const RadianceShot&, capture::RawFrame&)>& spoil,
                      const Rig& told) {
    const RadianceShots shots(rig_, true);
    try {
      calibrate_radiance(told, [&](const RadianceShot& s) {
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

// 50 seeds: bias within the instrument's limits and four of its own standard deviations, scatter as
// predicted. A ratio from 50 draws scatters by 10 %.
TEST_F(CalibrateRadiance, FiftySeedsAreUnbiasedAndKnowTheirScatter) {
  Rig told = rig_;
  told.calibration.radiance->white->plane.albedo_relative_std = 0;  // the albedo is not drawn
  const VirtualSensor sensor(rig_, true);
  double mean_log_time = 0;
  std::vector<double> stated;
  for (const RadianceShot& s : rig_.calibration.radiance->flats) {
    if (std::find(stated.begin(), stated.end(), *s.exposure_s) == stated.end()) {
      stated.push_back(*s.exposure_s);
    }
  }
  for (const double t : stated) {
    mean_log_time += std::log(sensor.true_exposure_s(t) / t) / static_cast<double>(stated.size());
  }
  Draws gain{"gain", 0.01}, linearity{"linearity", 0.001}, vignetting{"vignetting", 0.002},
      scale{"scale", 0.003}, glare{"glare", 0.0005}, black{"black", 0.05}, read{"read", 0.02},
      time{"time", 0.003};
  double share_squares = 0, share_predicted = 0;  // over the frame
  Vignetting v = vignetting_of_frame(120, 80);
  v.radial = rig_.truth_sensor.vignetting_radial;
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    const RadianceCalibration c = calibrated(told, rig_, seed).calibration;
    const capture::RadianceCorrection& k = c.correction;
    gain.add(k.noise[1].gain_e_per_count / 6.0 - 1.0, c.gain_std_e_per_count[1] / 6.0);
    read.add(k.noise[1].read_noise_counts - 1.2, c.read_noise_std_counts[1]);
    const double y = 2500.0;
    const Eigen::RowVectorXd w = ResponseCurve::weights(k.response[0].knot_counts(), y);
    const Eigen::Map<const Eigen::MatrixXd> covariance(c.response_covariance[0].data(), w.size(),
                                                       w.size());
    linearity.add(k.response[0].log_ratio_at(y) - true_log_ratio(rig_, y),
                  std::sqrt((w * covariance * w.transpose()).value()));
    vignetting.add(k.vignetting.share(20, 15, 1) - v.share(20, 15, 1), k.vignetting_std);
    for (std::size_t colour = 0; colour < kRgb; ++colour) {
      for (int x = 0; x <= 8; ++x) {
        for (int y_px = 0; y_px <= 8; ++y_px) {
          const double e = k.vignetting.share(119.0 * x / 8, 79.0 * y_px / 8, colour) -
                           v.share(119.0 * x / 8, 79.0 * y_px / 8, colour);
          share_squares += e * e / (50 * 3 * 81);
        }
      }
    }
    share_predicted += k.vignetting_std * k.vignetting_std / 50;
    glare.add(k.glare_share[1] - 0.02 / 1.02, k.glare_std[1]);
    black.add(k.black_counts[1] - 64.0, k.black_std_counts);
    const capture::ShutterSetting s = k.setting(1.0 / 60);
    time.add(std::log(s.true_over_stated * 64.0 / 60.0) + mean_log_time, s.relative_std);
    ASSERT_TRUE(c.responsivity);
    // The settings' mean error is the responsivity's.
    scale.add(std::log((*c.responsivity)[1] / 2.9e10) - mean_log_time, c.responsivity_relative_std);
  }
  for (const Draws* d : {&gain, &linearity, &vignetting, &scale, &glare, &black, &read, &time}) {
    SCOPED_TRACE(d->name);
    std::printf("%-10s bias %+.3g scatter %.3g predicted/sampled %.2f\n", d->name.c_str(),
                d->bias(), d->scatter(), d->ratio());
    EXPECT_LT(std::abs(d->bias()), d->bias_limit);
    EXPECT_LT(std::abs(d->bias()), 4.0 * d->scatter() / std::sqrt(d->n));
  }
  EXPECT_NEAR(gain.ratio(), 1.0, 0.2);
  EXPECT_NEAR(linearity.ratio(), 1.0, 0.2);
  std::printf("vignetting over the frame: rms %.3g predicted/sampled %.2f\n",
              std::sqrt(share_squares), std::sqrt(share_predicted / share_squares));
  EXPECT_NEAR(scale.ratio(), 1.0, 0.2);
  EXPECT_NEAR(time.ratio(), 1.0, 0.2);
}

TEST_F(CalibrateRadiance, FindsTheHotPixels) {
  const RadianceCalibration c = calibrated(rig_, rig_, 3).calibration;
  const capture::RawFrame quiet =
      VirtualSensor(rig_, false).frame(std::vector<float>(9600, 0.0F), 2.0, 1);
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
  rig_.camera.sensor.nef_lossy_curve = true;
  const RadianceCalibration c = calibrated(rig_, rig_, 3).calibration;
  EXPECT_NEAR(c.correction.noise[1].gain_e_per_count, 6.0, 5 * c.gain_std_e_per_count[1]);
  EXPECT_NEAR(c.correction.response[0].log_ratio_at(2500), true_log_ratio(rig_, 2500), 0.004);
}

TEST_F(CalibrateRadiance, FileComesBack) {
  const RadianceCalibration c = calibrated(rig_, rig_, 3).calibration;
  const TemporaryFolder folder;
  write_file(folder / "r.yaml", radiance_file_text(c));
  const RadianceCalibration read = read_radiance_file(folder / "r.yaml");
  EXPECT_EQ(radiance_file_text(read), radiance_file_text(c));
  EXPECT_EQ(read.correction.defect_pixels, c.correction.defect_pixels);
  // The points lie about the curve that was fitted to them.
  ASSERT_GT(read.linearity.size(), 3U);
  const Plot plot = linearity_plot(read);
  ASSERT_EQ(plot.series.size(), 4U);
  for (const RadiancePoint& p : read.linearity) {
    const double curve = std::expm1(-c.correction.response[0].log_ratio_at(p.counts));
    EXPECT_NEAR(p.value, curve, 0.002 + 5.0 * p.std) << p.counts;
  }
  for (std::size_t k = 0; k < kRgb; ++k) {
    EXPECT_GT(read.noise[k].size(), 3U);
    EXPECT_EQ(photon_transfer_plot(read, k).series.size(), 2U);
  }
  EXPECT_NE(radiance_table(c).find("gain R"), std::string::npos);
  std::string other = radiance_file_text(c);
  other.replace(other.find(": 1"), 3, ": 2");
  write_file(folder / "r.yaml", other);
  EXPECT_THROW(read_radiance_file(folder / "r.yaml"), InputError);
}

TEST(RadiancePoints, AreMeansOfHalfOctaves) {
  // 100 and 110 share half an octave, 200 is alone.
  const std::vector<RadiancePoint> points =
      radiance_points({100, 110, 100, 110, 200, -5}, {1, 3, 1, 3, 9, 9}, 2);
  ASSERT_EQ(points.size(), 1U);
  EXPECT_DOUBLE_EQ(points[0].counts, 105);
  EXPECT_DOUBLE_EQ(points[0].value, 2);
  EXPECT_NEAR(points[0].std, std::sqrt(4.0 / 3.0 / 4.0), 1e-12);
  EXPECT_THROW(radiance_points({1}, {}), std::invalid_argument);
}

TEST_F(CalibrateRadiance, RefusesDarkFramesWithLight) {
  const auto add = [](double counts, bool one_side) {
    return [=](const RadianceShot& s, capture::RawFrame& f) {
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
      [](const RadianceShot& s, capture::RawFrame& f) {
        if (s.file == "dark2.dng") f.iso = 400;
      },
      rig_);
  EXPECT_NE(what.find("dark2.dng: ISO 400"), std::string::npos) << what;
  what = refusal(
      [](const RadianceShot& s, capture::RawFrame& f) {
        if (s.file.starts_with("white")) f.f_number = 5.6;
      },
      rig_);
  EXPECT_NE(what.find("f/5.6"), std::string::npos) << what;
}

TEST_F(CalibrateRadiance, RefusesFlatsThatAreClippedOrDark) {
  Rig bright = rig_;
  for (double& l : *rig_.calibration.radiance->flat_radiance_W_per_mm2_sr) l *= 3;
  std::string what = refusal([](const RadianceShot&, capture::RawFrame&) {}, bright);
  EXPECT_NE(what.find("clipped"), std::string::npos) << what;
  for (double& l : *rig_.calibration.radiance->flat_radiance_W_per_mm2_sr) l *= 1e-4;
  what = refusal([](const RadianceShot&, capture::RawFrame&) {}, bright);
  EXPECT_NE(what.find("expose longer"), std::string::npos) << what;
}

TEST_F(CalibrateRadiance, NeedsPairsAndThreeTimes) {
  const auto nothing = [](const RadianceShot&, capture::RawFrame&) {};
  Rig told = rig_;
  std::vector<RadianceShot>& flats = told.calibration.radiance->flats;
  // One frame of one pair is missing: said, not refused.
  flats.erase(flats.begin() + 3);
  EXPECT_EQ(refusal(nothing, told), "accepted");
  const RadianceCalibration c = calibrated(told, rig_, 1).calibration;
  ASSERT_EQ(c.notes.size(), 1U);
  EXPECT_NE(c.notes[0].find("0.008 s stands alone"), std::string::npos) << c.notes[0];
  // No pair at all.
  std::vector<RadianceShot> singles;
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
                [&](const RadianceShot& s, capture::RawFrame& f) {
                  if (s.file.starts_with("flat")) {
                    for (auto& v : f.samples) v = static_cast<std::uint16_t>(500);
                  }
                },
                rig_)
                .find("does not grow"),
            std::string::npos);
}

TEST_F(CalibrateRadiance, RefusesTrapsOutOfTheFrameAndPlanesOutOfView) {
  const auto nothing = [](const RadianceShot&, capture::RawFrame&) {};
  Rig told = rig_;
  told.calibration.radiance->glare->traps_px[0].x = 110;
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
