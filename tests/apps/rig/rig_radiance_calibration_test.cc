#include "apps/rig/rig_radiance_calibration.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/apps/yaml_text.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

constexpr const char* kDarkAndFlats =
    "dark: [d1.dng, {file: d2.dng, exposure_s: 2}]\n"
    "flats: [{file: f1.dng, exposure_s: 0.02}, {file: f2.dng, lamp: 0.2}]\n";
constexpr const char* kWhite =
    "white: {file: w.dng, exposure_s: 0.04, light: led1, size_mm: [30, 20], albedo: [0.95, 0.96, "
    "0.94]}\n";
constexpr const char* kGlare =
    "glare: {shots: [{file: g1.dng, exposure_s: 0.01}, g2.dng], traps_px: [[4, 5, 24, 60], [90, "
    "10, 2, 2]], bright_px: [40, 20, 30, 50], bright_radiance_W_per_mm2_sr: [1e-6, 2e-6, 3e-6], "
    "relative_std: 0.1}\n";

calib::RadianceCalibrationShots radiance_shots_of(const std::string& text) {
  return read_radiance_calibration(yaml_text(text), "rig.yaml");
}

TEST(RigRadianceCalibration, ReadsEveryPart) {
  const calib::RadianceCalibrationShots c = radiance_shots_of(
      std::string(kDarkAndFlats) + "flat_radiance_W_per_mm2_sr: [2.9e-6, 2.45e-6, 3.2e-6]\n" +
      kWhite + kGlare);
  ASSERT_EQ(c.dark.size(), 2U);
  EXPECT_EQ(c.dark[0].file, "d1.dng");
  EXPECT_FALSE(c.dark[0].exposure_s.has_value());
  EXPECT_EQ(c.dark[1].exposure_s, 2.0);
  ASSERT_EQ(c.flats.size(), 2U);
  EXPECT_EQ(c.flats[0].lamp, 1.0);
  EXPECT_EQ(c.flats[1].lamp, 0.2);
  EXPECT_EQ(c.at(c.flats[1].line), "rig.yaml:2");
  EXPECT_EQ(c.flat_radiance_W_per_mm2_sr, (std::array<double, 3>{2.9e-6, 2.45e-6, 3.2e-6}));
  ASSERT_TRUE(c.white.has_value());
  ASSERT_EQ(c.white->shots.size(), 1U);
  EXPECT_EQ(c.white->shots[0].file, "w.dng");
  EXPECT_EQ(c.white->shots[0].exposure_s, 0.04);
  EXPECT_EQ(c.white->light, "led1");
  EXPECT_EQ(c.white->plane.width_mm, 30.0);
  EXPECT_EQ(c.white->plane.albedo_relative_std, 0.005);  // not stated
  ASSERT_TRUE(c.glare.has_value());
  ASSERT_EQ(c.glare->shots.size(), 2U);
  EXPECT_EQ(c.glare->shots[0].exposure_s, 0.01);
  EXPECT_EQ(c.glare->shots[1].file, "g2.dng");
  ASSERT_EQ(c.glare->traps_px.size(), 2U);
  EXPECT_EQ(c.glare->traps_px[0].x0, 4);
  EXPECT_EQ(c.glare->traps_px[0].y0, 5);
  EXPECT_EQ(c.glare->traps_px[0].width, 24);
  EXPECT_EQ(c.glare->traps_px[0].height, 60);
  ASSERT_TRUE(c.glare->bright_px.has_value());
  EXPECT_EQ(c.glare->bright_px->height, 50);
  EXPECT_EQ(c.glare->bright_radiance_W_per_mm2_sr, (std::array<double, 3>{1e-6, 2e-6, 3e-6}));
  EXPECT_EQ(c.glare->relative_std, 0.1);
}

TEST(RigRadianceCalibration, DarkAndFlatsAreEnough) {
  const calib::RadianceCalibrationShots c = radiance_shots_of(kDarkAndFlats);
  EXPECT_FALSE(c.flat_radiance_W_per_mm2_sr || c.white || c.glare);
}

TEST(RigRadianceCalibration, NamesWhatIsWrong) {
  const auto refused = [](const std::string& text) {
    return refusal_of([&] { radiance_shots_of(text); });
  };
  const auto changed = [&](std::string text, const std::string& from, const std::string& to) {
    return refused(kDarkAndFlats + text.replace(text.find(from), from.size(), to));
  };
  EXPECT_THAT(refused("dark: [a.dng]\n"), HasSubstr("flats: is missing"));
  EXPECT_THAT(refused("dark: []\nflats: [a.dng]\n"), HasSubstr("dark: expected at least one shot"));
  EXPECT_THAT(refused("dark: [a.dng, a.dng]\nflats: [b.dng]\n"),
              HasSubstr("dark[1]: the file is listed twice"));
  EXPECT_THAT(refused("dark: [{file: a.dng, lamp: 2}]\nflats: [b.dng]\n"),
              HasSubstr("dark[0].lamp: unknown key"));
  EXPECT_THAT(refused("dark: [a.dng]\nflats: [{file: b.dng, lamp: 0}]\n"),
              HasSubstr("flats[0].lamp"));
  EXPECT_THAT(changed(kWhite, "file: w.dng, ", ""), HasSubstr("expected either file or shots"));
  EXPECT_THAT(changed(kWhite, "file: w.dng", "file: w.dng, shots: [v.dng]"),
              HasSubstr("expected either file or shots"));
  EXPECT_THAT(changed(kWhite, "file: w.dng", "shots: [w.dng]"), HasSubstr("white.exposure_s:"));
  EXPECT_THAT(changed(kWhite, "light: led1, ", ""), HasSubstr("white.light: is missing"));
  EXPECT_THAT(changed(kGlare, "[[4, 5, 24, 60], [90, 10, 2, 2]]", "[]"),
              HasSubstr("glare.traps_px: expected at least one rectangle"));
  EXPECT_THAT(changed(kGlare, "[90, 10, 2, 2]", "[90, 10, 1, 2]"),
              HasSubstr("glare.traps_px[1][2]"));
}

}  // namespace
}  // namespace scattermeter::apps
