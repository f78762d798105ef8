#include "apps/simulation/radiance_shots.h"

#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capture/raw/raw_reader.h"
#include "core/view/camera_view.h"
#include "tests/fixtures/apps/radiance_rig.h"
#include "tests/fixtures/apps/yaml_text.h"

namespace scattermeter::apps {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

// The sensor has no errors but those that a test gives it; black is 64, white 4095.
class RadianceShotsTest : public ::testing::Test {
 protected:
  RadianceShotsTest() : rig_(radiance_rig()) { rig_.truth.sensor = {}; }
  calib::RadianceCalibrationShots& listed() { return *rig_.calibration.radiance; }
  std::size_t channel(int x, int y) const {
    return static_cast<std::size_t>(rig_.scene.camera.sensor.cfa.at(x, y));
  }
  std::string refused() {
    return refusal_of([&] { RadianceShots(rig_, false); });
  }
  Rig rig_;
};

TEST_F(RadianceShotsTest, AllInOrder) {
  const std::vector<calib::RadianceShot> all = all_radiance_shots(listed());
  ASSERT_EQ(all.size(), 6U + 24U + 2U + 1U);
  EXPECT_EQ(all[0].file, listed().dark[0].file);
  EXPECT_EQ(all[6].file, listed().flats[0].file);
  EXPECT_EQ(all[30].file, listed().white->shots[0].file);
  EXPECT_EQ(all[32].file, listed().glare->shots[0].file);
  listed().white.reset();
  listed().glare.reset();
  EXPECT_EQ(all_radiance_shots(listed()).size(), 30U);
}

TEST_F(RadianceShotsTest, DarkFramesAreBlack) {
  rig_.truth.sensor.dark_current_counts_per_s = 3.0;
  const RadianceShots shots(rig_, false);
  const calib::RadianceShot& two_seconds = listed().dark.back();
  EXPECT_EQ(shots.exposure_s(two_seconds), 2.0);
  const capture::RawFrame frame = shots.frame(two_seconds, 1);
  EXPECT_EQ(frame.samples, std::vector<std::uint16_t>(120U * 80U, 64 + 6));
  EXPECT_EQ(frame.exposure_s, 2.0);
}

// Responsivity x radiance x lamp x time, in the channel of each filter.
TEST_F(RadianceShotsTest, FlatsAreEven) {
  const RadianceShots shots(rig_, false);
  for (const std::size_t i : {std::size_t{0}, std::size_t{23}}) {
    const calib::RadianceShot& flat = listed().flats[i];
    const capture::RawFrame frame = shots.frame(flat, 1);
    for (int y = 0; y < 80; ++y) {
      for (int x = 0; x < 120; ++x) {
        const std::size_t c = channel(x, y);
        const double counts = (*rig_.scene.camera.responsivity)[c] *
                              (*listed().flat_radiance_W_per_mm2_sr)[c] * flat.lamp *
                              *flat.exposure_s;
        ASSERT_NEAR(frame.at(x, y) - 64.0, counts, 0.5001);
      }
    }
  }
  EXPECT_EQ(listed().flats[23].lamp, 0.2);
}

// albedo I cos cos / (pi r^2) on the plane, nothing beside it.
TEST_F(RadianceShotsTest, TheWhitePlaneIsLitByItsLed) {
  const RadianceShots shots(rig_, false);
  const calib::WhiteReference& white = *listed().white;
  const capture::RawFrame frame = shots.frame(white.shots[0], 1);
  const Rigid3d pose = look_at({0, -100, 150}, {0, 0, 0}, {0, 0, 1});
  const Led& led = rig_.scene.lights[0].led()->led;
  for (const Eigen::Vector2d& place : {Eigen::Vector2d(-10, -5), {0, 0}, {9, 6}}) {
    const Eigen::Vector3d p(place.x(), place.y(), 0);
    const Eigen::Vector2d at = project(rig_.scene.camera.intrinsics, pose, {p}).front();
    const int x = static_cast<int>(std::lround(at.x()));
    const int y = static_cast<int>(std::lround(at.y()));
    const std::size_t c = channel(x, y);
    const Eigen::Vector3d to_led = led.position_mm - p;
    const double irradiance =
        0.05 * -led.axis.dot(to_led.normalized()) * to_led.normalized().z() / to_led.squaredNorm();
    const double counts = (*rig_.scene.camera.responsivity)[c] / 30.0 *
                          white.plane.albedo[static_cast<Eigen::Index>(c)] / std::numbers::pi *
                          irradiance;
    // Half a pixel of 0.6 mm is 0.5 % of the light's distance.
    EXPECT_NEAR(frame.at(x, y) - 64.0, counts, 0.015 * counts) << place.transpose();
  }
  EXPECT_EQ(frame.at(0, 0), 64);
  EXPECT_EQ(frame.at(119, 79), 64);
}

TEST_F(RadianceShotsTest, TheGlareTargetIsARectangle) {
  const RadianceShots shots(rig_, false);
  const capture::RawFrame frame = shots.frame(listed().glare->shots[0], 1);
  for (int y = 0; y < 80; ++y) {
    for (int x = 0; x < 120; ++x) {
      const std::size_t c = channel(x, y);
      const bool is_bright = x >= 40 && x < 80 && y >= 20 && y < 60;
      const double counts = is_bright ? (*rig_.scene.camera.responsivity)[c] *
                                            listed().glare->bright_radiance_W_per_mm2_sr[c] / 20.0
                                      : 0.0;
      ASSERT_NEAR(frame.at(x, y) - 64.0, counts, 0.5001);
    }
  }
}

TEST_F(RadianceShotsTest, FilesAreTheFrames) {
  const RadianceShots shots(rig_, true);
  const TemporaryFolder folder;
  const calib::RadianceShot& flat = listed().flats[3];
  shots.write(flat, 5, folder / "flat.dng");
  const capture::RawFrame read = capture::read_raw(folder / "flat.dng");
  EXPECT_TRUE(read.samples == shots.frame(flat, 5).samples);
  EXPECT_FALSE(read.samples == shots.frame(flat, 6).samples);
  // The second flat of a pair has noise of its own.
  EXPECT_FALSE(read.samples == shots.frame(listed().flats[2], 5).samples);
}

TEST_F(RadianceShotsTest, NamesWhatTheRigLacks) {
  EXPECT_EQ(refused(), "");
  listed().dark[2].exposure_s.reset();
  EXPECT_THAT(refused(), AllOf(HasSubstr("exposure_s: is missing"), HasSubstr("dark3.dng")));
  rig_.scene.camera.exposure_s = 0.25;
  EXPECT_EQ(refused(), "");
  EXPECT_EQ(RadianceShots(rig_, false).exposure_s(listed().dark[2]), 0.25);
  listed().glare->bright_px.reset();
  EXPECT_THAT(refused(), HasSubstr("glare.bright_px: is missing"));
  listed().flat_radiance_W_per_mm2_sr.reset();
  EXPECT_THAT(refused(), HasSubstr("flat_radiance_W_per_mm2_sr: is missing"));
}

}  // namespace
}  // namespace scattermeter::apps
