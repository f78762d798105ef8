#include "capture/sensor/virtual_sensor.h"

#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "apps/rig/rig.h"
#include "capture/raw/raw_reader.h"
#include "capture/raw/tiff_layout.h"
#include "core/base/input_error.h"
#include "core/camera/vignetting.h"
#include "tests/fixtures/apps/small_rig.h"

namespace scattermeter::apps {
namespace {

class VirtualSensorTest : public ::testing::Test {
 protected:
  VirtualSensorTest() : rig_(read_rig(files_.rig())) {
    n_ = static_cast<std::size_t>(rig_.scene.camera.intrinsics.width_px) *
         static_cast<std::size_t>(rig_.scene.camera.intrinsics.height_px);
  }
  std::vector<float> even(float counts) const { return std::vector<float>(n_, counts); }
  double mean_above_black(const capture::RawFrame& f) const {
    return std::accumulate(f.samples.begin(), f.samples.end(), 0.0) / static_cast<double>(n_) - 64;
  }

  SmallRig files_;
  Rig rig_;
  std::size_t n_;
};

TEST_F(VirtualSensorTest, WithoutTruthItOnlyExposes) {
  const capture::VirtualSensor sensor(rig_.scene, rig_.truth.sensor, true);
  EXPECT_EQ(sensor.codes(even(500), 0.1, 7),
            capture::expose(even(500), 484, 324, sensor.model(), 7));
}

TEST_F(VirtualSensorTest, FileHoldsTheFrame) {
  rig_.truth.sensor.vignetting_radial.fill({-0.3});
  const capture::VirtualSensor sensor(rig_.scene, rig_.truth.sensor, true);
  sensor.write(files_ / "a.dng", even(500), 0.1, 7);
  EXPECT_EQ(capture::read_raw(files_ / "a.dng").samples, sensor.frame(even(500), 0.1, 7).samples);
}

TEST_F(VirtualSensorTest, NefHoldsTheFrame) {
  rig_.truth.sensor.format = capture::RawFormat::kNef;
  rig_.scene.camera.sensor.nef_lossy_curve = true;
  rig_.scene.camera.model = "NIKON D80";
  const capture::VirtualSensor sensor(rig_.scene, rig_.truth.sensor, true);
  sensor.write(files_ / "a.nef", even(500), 0.1, 7);
  const capture::RawFrame read = capture::read_raw(files_ / "a.nef");
  const capture::RawFrame made = sensor.frame(even(500), 0.1, 7);
  EXPECT_EQ(read.samples, made.samples);
  EXPECT_EQ(read.curve_levels, made.curve_levels);
  EXPECT_EQ(read.black_counts, made.black_counts);
  EXPECT_EQ(read.model, "D80");
  EXPECT_FALSE(capture::tiff_layout(files_ / "a.nef").is_dng);
}

TEST_F(VirtualSensorTest, ExposureTimesAreTheShutters) {
  rig_.truth.sensor.shutter_in_thirds = true;
  rig_.truth.sensor.exposures = {{0.125, 0.13}};
  const capture::VirtualSensor sensor(rig_.scene, rig_.truth.sensor, false);
  EXPECT_NEAR(sensor.true_exposure_s(1.0 / 60), 1.0 / 64, 1e-12);
  EXPECT_NEAR(sensor.true_exposure_s(0.125), 0.13, 1e-12);
  EXPECT_NEAR(mean_above_black(sensor.frame(even(1000), 0.125, 1)), 1040, 0.5);
  EXPECT_NEAR(mean_above_black(sensor.frame(even(1000), 1.0 / 60, 1)), 937.5, 0.5);
}

TEST_F(VirtualSensorTest, CornersAreDarkerByTheVignetting) {
  rig_.truth.sensor.vignetting_radial = {std::vector<double>{-0.2}, {-0.3}, {-0.4}};
  const capture::RawFrame f =
      capture::VirtualSensor(rig_.scene, rig_.truth.sensor, false).frame(even(2000), 0.1, 1);
  Vignetting v = vignetting_of_frame(484, 324);
  v.radial = rig_.truth.sensor.vignetting_radial;
  for (const auto& [x, y, c] : {std::tuple{0, 0, 0U}, {101, 40, 1U}, {483, 323, 2U}}) {
    EXPECT_NEAR(f.at(x, y) - 64.0, 2000 * v.share(x, y, c), 0.51);
  }
}

TEST_F(VirtualSensorTest, GlareIsAShareOfTheColoursMean) {
  rig_.truth.sensor.veiling_glare = 0.05;
  std::vector<float> signal = even(0);
  for (std::size_t i = 0; i < n_ / 2; ++i) signal[i] = 1000;  // upper half
  const capture::RawFrame f =
      capture::VirtualSensor(rig_.scene, rig_.truth.sensor, false).frame(signal, 0.1, 1);
  EXPECT_EQ(f.at(10, 300), 64 + 25);
  EXPECT_EQ(f.at(10, 10), 64 + 1025);
}

TEST_F(VirtualSensorTest, DarkCurrentAndHotPixelsGrowWithTime) {
  rig_.truth.sensor.dark_current_counts_per_s = 20;
  rig_.truth.sensor.hot_pixel_share = 1e-3;
  rig_.truth.sensor.hot_pixel_counts_per_s = 400;
  const capture::VirtualSensor sensor(rig_.scene, rig_.truth.sensor, false);
  const capture::RawFrame f = sensor.frame(even(0), 1.0, 1);
  const auto hot = std::count_if(f.samples.begin(), f.samples.end(), [](int v) { return v > 84; });
  EXPECT_NEAR(static_cast<double>(hot), 156.8, 5 * std::sqrt(156.8));
  const capture::RawFrame other = sensor.frame(even(0), 1.0, 2);
  EXPECT_EQ(f.samples, other.samples) << "hot pixels are the camera's";
  EXPECT_NEAR(mean_above_black(f), 20 + 400e-3 * std::exp(0.125), 0.12);
}

TEST_F(VirtualSensorTest, CountsDepartAtTheTop) {
  rig_.truth.sensor.non_linearity = -0.01;
  const capture::RawFrame f =
      capture::VirtualSensor(rig_.scene, rig_.truth.sensor, false).frame(even(2000), 0.1, 1);
  EXPECT_NEAR(f.at(3, 3) - 64.0, 2000 * (1 - 0.01 * 2000 / (4095 - 64)), 0.51);
}

TEST_F(VirtualSensorTest, BlackDriftsFromShotToShot) {
  rig_.truth.sensor.black_drift_counts = 3;
  const capture::VirtualSensor sensor(rig_.scene, rig_.truth.sensor, true);
  double sum2 = 0;
  for (std::uint64_t i = 0; i < 20; ++i) {
    const double d = mean_above_black(
        sensor.frame(even(0), 0.1, capture::VirtualSensor::stream(1, std::to_string(i) + ".dng")));
    sum2 += d * d;
  }
  EXPECT_GT(sum2 / 20, 9 * 0.35);
  EXPECT_LT(sum2 / 20, 9 * 2.0);
}

TEST_F(VirtualSensorTest, RadianceNeedsAResponsivity) {
  EXPECT_NEAR(capture::VirtualSensor(rig_.scene, rig_.truth.sensor, true)
                  .signal_counts(even(1e-7F), 0.1)[0],
              240, 0.01);
  rig_.scene.camera.responsivity.reset();
  EXPECT_THROW(
      capture::VirtualSensor(rig_.scene, rig_.truth.sensor, true).signal_counts(even(1e-7F), 0.1),
      InputError);
}

TEST_F(VirtualSensorTest, IsReadFromTheRig) {
  files_.write(files_.text() + R"(  sensor:
    vignetting: {R: [-0.2], G: [-0.3, 0.05], B: []}
    veiling_glare: 0.01
    hot_pixels: {share: 1.0e-4, counts_per_s: 300}
    dark_current_counts_per_s: 2
    black_drift_counts: 0.3
    non_linearity: -0.01
    shutter: thirds
    exposures: [{stated_s: 0.1, true_s: 0.098}]
)");
  const capture::SensorTruth t = read_rig(files_.rig()).truth.sensor;
  EXPECT_EQ(t.vignetting_radial[1], (std::vector<double>{-0.3, 0.05}));
  EXPECT_EQ(t.veiling_glare, 0.01);
  EXPECT_EQ(t.hot_pixel_share, 1e-4);
  EXPECT_EQ(t.black_drift_counts, 0.3);
  EXPECT_TRUE(t.shutter_in_thirds);
  ASSERT_EQ(t.exposures.size(), 1U);
  files_.write(replaced(files_.text(), "shutter: thirds", "shutter: halves"));
  EXPECT_THROW(read_rig(files_.rig()), InputError);
}

}  // namespace
}  // namespace scattermeter::apps
