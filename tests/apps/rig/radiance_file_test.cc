#include "apps/rig/radiance_file.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/apps/yaml_text.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

// Every number another one, with digits that a shorter text would lose.
capture::RadianceCalibration made_radiance() {
  capture::RadianceCalibration made;
  capture::RadianceCorrection& c = made.correction;
  c.width_px = 120;
  c.height_px = 80;
  c.iso = 400;
  c.f_number = 5.6;
  c.black_counts = {128.0 / 3.0, 43, 44, 45};
  c.dark_counts_per_s = {1.0 / 7.0, -0.1, 0, 2};
  c.black_std_counts = 0.05;
  c.defect_pixels = {0, 119, 120, 9599};  // corners of the frame, and the second row's first
  c.vignetting = vignetting_of_frame(120, 80);
  for (std::size_t k = 0; k < kRgb; ++k) {
    const double x = static_cast<double>(k) + 1.0;
    c.noise[k] = {6.0 / x, 1.2 / 7.0 * x};
    made.gain_std_e_per_count[k] = 0.01 * x;
    made.read_noise_std_counts[k] = 0.02 * x;
    c.response[k] = ResponseCurve({1000.0 * x, 3000.0 * x}, {0.001 / x, 0.01 / x});
    made.response_covariance[k] = {0.0001, 0.0, 0.0, 0.0009 * x * x};
    c.vignetting.radial[k] = {-0.3 / x, 0.05};
    c.vignetting.map[k] = {0.01 * x};
    c.glare_share[k] = 0.02 * x;
    c.glare_std[k] = 0.001 * x;
    made.noise[k] = {{100.0 * x, 20.0, 0.5}};
  }
  c.vignetting_std = 0.002;
  c.shutter = {{0.005, 1.01, 0.001}, {0.25, 0.99, 0.002}};
  c.shutter_relative_std = 0.003;
  made.responsivity = {2.4e10 / 3.0, 2.9e10, 2.1e10};
  made.responsivity_relative_std = 0.011;
  made.linearity = {{50.0, -0.001, 0.0002}, {800.0, -0.01 / 3.0, 0.0001}};
  made.residuals = {{"the camera's flats: R", 0.1, -0.3, 1.0, "% of 1"}, {"b", 1, 2, 3, "px"}};
  made.notes = {"it's a note"};
  return made;
}

class RadianceFile : public ::testing::Test {
 protected:
  capture::RadianceCalibration read(const std::string& text) const {
    write_file(folder_ / "radiance.yaml", text);
    return read_radiance_file(folder_ / "radiance.yaml");
  }
  std::string refused(const std::string& from, const std::string& to) const {
    std::string text = radiance_file_text(made_radiance());
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from << " is not in\n" << text;
    return refusal_of([&] { read(text.replace(at, from.size(), to)); });
  }
  TemporaryFolder folder_;
};

TEST_F(RadianceFile, ReadsBackToTheLastDigit) {
  const capture::RadianceCalibration made = made_radiance();
  const capture::RadianceCalibration back = read(radiance_file_text(made));
  const capture::RadianceCorrection& a = made.correction;
  const capture::RadianceCorrection& b = back.correction;
  EXPECT_EQ(b.width_px, 120);
  EXPECT_EQ(b.height_px, 80);
  EXPECT_EQ(b.iso, a.iso);
  EXPECT_EQ(b.f_number, a.f_number);
  EXPECT_EQ(b.black_counts, a.black_counts);
  EXPECT_EQ(b.dark_counts_per_s, a.dark_counts_per_s);
  EXPECT_EQ(b.black_std_counts, a.black_std_counts);
  EXPECT_EQ(b.defect_pixels, a.defect_pixels);
  EXPECT_EQ(b.vignetting.center_px, a.vignetting.center_px);
  EXPECT_EQ(b.vignetting.half_diagonal_px, a.vignetting.half_diagonal_px);
  for (std::size_t k = 0; k < kRgb; ++k) {
    EXPECT_EQ(b.noise[k].gain_e_per_count, a.noise[k].gain_e_per_count);
    EXPECT_EQ(b.noise[k].read_noise_counts, a.noise[k].read_noise_counts);
    EXPECT_EQ(b.response[k].knot_counts(), a.response[k].knot_counts());
    EXPECT_EQ(b.response[k].log_ratio(), a.response[k].log_ratio());
    EXPECT_EQ(b.vignetting.radial[k], a.vignetting.radial[k]);
    EXPECT_EQ(b.vignetting.map[k], a.vignetting.map[k]);
    EXPECT_EQ(back.response_covariance[k], made.response_covariance[k]);
  }
  EXPECT_EQ(back.gain_std_e_per_count, made.gain_std_e_per_count);
  EXPECT_EQ(back.read_noise_std_counts, made.read_noise_std_counts);
  EXPECT_EQ(b.glare_share, a.glare_share);
  EXPECT_EQ(b.glare_std, a.glare_std);
  EXPECT_EQ(b.vignetting_std, a.vignetting_std);
  ASSERT_EQ(b.shutter.size(), 2U);
  EXPECT_EQ(b.setting(0.25).true_over_stated, 0.99);
  EXPECT_EQ(b.setting(0.25).relative_std, 0.002);
  EXPECT_EQ(b.setting(1.0).relative_std, 0.003);
  EXPECT_EQ(back.responsivity, made.responsivity);
  EXPECT_EQ(back.responsivity_relative_std, made.responsivity_relative_std);
  ASSERT_EQ(back.linearity.size(), 2U);
  EXPECT_EQ(back.linearity[1].value, made.linearity[1].value);
  EXPECT_EQ(back.noise[2].at(0).counts, 300.0);
  ASSERT_EQ(back.residuals.size(), 2U);
  EXPECT_EQ(back.residuals[0].what, "the camera's flats: R");
  EXPECT_EQ(back.residuals[0].worst, -0.3);
  EXPECT_EQ(back.residuals[0].unit, "% of 1");
  EXPECT_EQ(back.notes, made.notes);
  // Nothing that the text holds is lost.
  EXPECT_EQ(radiance_file_text(back), radiance_file_text(made));
}

TEST_F(RadianceFile, WithoutAWhiteReferenceThereIsNoResponsivity) {
  capture::RadianceCalibration made = made_radiance();
  made.responsivity.reset();
  made.linearity.clear();
  made.residuals.clear();
  made.notes.clear();
  const std::string text = radiance_file_text(made);
  EXPECT_THAT(text, ::testing::Not(HasSubstr("responsivity")));
  EXPECT_THAT(text, ::testing::Not(HasSubstr("curves")));
  EXPECT_FALSE(read(text).responsivity.has_value());
}

TEST_F(RadianceFile, NamesWhatIsWrong) {
  EXPECT_THAT(refused("scattermeter_radiance: 1", "scattermeter_radiance: 2"),
              HasSubstr("version 1"));
  EXPECT_THAT(refused("[119, 79]", "[120, 79]"), HasSubstr("defect_pixels[3]"));
  EXPECT_THAT(refused("gain_e_per_count: 6", "gain_e_per_count: 0"),
              HasSubstr("colours.R.gain_e_per_count"));
  EXPECT_THAT(refused("true_over_stated: 1.01", "true_over_stated: 2.1"),
              HasSubstr("shutter.settings[0].true_over_stated"));
  EXPECT_THAT(
      refused("log_light_over_recorded: [0.001, 0.01]", "log_light_over_recorded: [0.6, 0]"),
      HasSubstr("colours.R.response: expected departures below 0.5"));
  EXPECT_THAT(refused("counts: [1000, 3000]", "counts: [3000, 1000]"),
              HasSubstr("colours.R.response"));
  EXPECT_THAT(refused("counts: [1000, 3000]", "counts: [3000]"),
              HasSubstr("expected as many values as counts"));
  EXPECT_THAT(refused("share: 0.02", "share: 0.95"), HasSubstr("colours.R.glare.share"));
  // 1 - 1.05 + 0.05 of the light is left in the corners.
  EXPECT_THAT(refused("radial: [-0.3, 0.05]", "radial: [-1.05, 0.05]"),
              HasSubstr("colours: vignetting: a share of"));
  EXPECT_THAT(refused("\nresponsivity_relative_std: 0.011", "\n# "),
              HasSubstr("responsivity_relative_std: is missing"));
  EXPECT_THAT(refused("iso: 400", "iso: fast"), HasSubstr("radiance.yaml:3: iso"));
}

}  // namespace
}  // namespace scattermeter::apps
