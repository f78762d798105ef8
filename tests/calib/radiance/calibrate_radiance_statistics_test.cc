// What `calibrate radiance` states of its errors, against noise drawn anew each time.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "calib/radiance/calibrate_radiance.h"
#include "capture/sensor/virtual_sensor.h"
#include "tests/fixtures/apps/radiance_rig.h"
#include "tests/fixtures/draws.h"

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

// Bias within the instrument's limits and four of its own standard deviations, scatter as
// predicted. A ratio from 50 draws scatters by 10 %.
TEST(CalibrateRadianceStatistics, SeedsAreUnbiasedAndKnowTheirScatter) {
  const int n = test_support::draws(10, 50);
  const Rig rig = radiance_rig(4);
  Rig told = rig;
  told.calibration.radiance->white->plane.albedo_relative_std = 0;  // the albedo is not drawn
  const capture::VirtualSensor sensor(rig.scene, rig.truth.sensor, true);
  double mean_log_time = 0;
  std::vector<double> stated;
  for (const calib::RadianceShot& s : rig.calibration.radiance->flats) {
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
  Vignetting v = vignetting_of_frame(480, 320);
  v.radial = rig.truth.sensor.vignetting_radial;
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(n); ++seed) {
    const capture::RadianceCalibration c = calibrated(told, rig, seed);
    const capture::RadianceCorrection& k = c.correction;
    gain.add(k.noise[1].gain_e_per_count / 6.0 - 1.0, c.gain_std_e_per_count[1] / 6.0);
    read.add(k.noise[1].read_noise_counts - 1.2, c.read_noise_std_counts[1]);
    const double y = 2500.0;
    const Eigen::RowVectorXd w = ResponseCurve::weights(k.response[0].knot_counts(), y);
    const Eigen::Map<const Eigen::MatrixXd> covariance(c.response_covariance[0].data(), w.size(),
                                                       w.size());
    linearity.add(k.response[0].log_ratio_at(y) - true_log_ratio(rig, y),
                  std::sqrt((w * covariance * w.transpose()).value()));
    vignetting.add(k.vignetting.share(80, 60, 1) - v.share(80, 60, 1), k.vignetting_std);
    for (std::size_t colour = 0; colour < kRgb; ++colour) {
      for (int x = 0; x <= 8; ++x) {
        for (int y_px = 0; y_px <= 8; ++y_px) {
          const double e = k.vignetting.share(479.0 * x / 8, 319.0 * y_px / 8, colour) -
                           v.share(479.0 * x / 8, 319.0 * y_px / 8, colour);
          share_squares += e * e / (n * 3 * 81);
        }
      }
    }
    share_predicted += k.vignetting_std * k.vignetting_std / n;
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
  for (const Draws* d : {&gain, &linearity, &vignetting, &scale}) {
    EXPECT_LT(d->scatter(), d->bias_limit) << d->name;
  }
  const double limit = test_support::limit_at(0.2, 50, n);
  EXPECT_NEAR(gain.ratio(), 1.0, limit);
  EXPECT_NEAR(linearity.ratio(), 1.0, limit);
  const double share_ratio = std::sqrt(share_predicted / share_squares);
  std::printf("vignetting over the frame: rms %.3g predicted/sampled %.2f\n",
              std::sqrt(share_squares), share_ratio);
  EXPECT_NEAR(share_ratio, 1.0, limit);
  EXPECT_NEAR(scale.ratio(), 1.0, limit);
  EXPECT_NEAR(time.ratio(), 1.0, limit);
}

}  // namespace
}  // namespace scattermeter::apps
