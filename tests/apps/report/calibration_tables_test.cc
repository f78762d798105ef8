#include "apps/report/calibration_tables.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/apps/made_camera.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

const calib::CalibrationBoard kTableBoard = {calib::BoardKind::kChessboard, 10, 7, 30.0, 0.0, ""};

TEST(CalibrationTables, NameOfABoard) {
  EXPECT_EQ(board_name(kTableBoard), "chess board of 10 x 7 squares of 30 mm");
  EXPECT_EQ(board_name({calib::BoardKind::kCharuco, 8, 6, 12.5, 9.0, "DICT_4X4_50"}),
            "ChArUco board of 8 x 6 squares of 12.5 mm");
}

TEST(CalibrationTables, Camera) {
  calib::CameraCalibrationRun run = made_camera();
  const std::string table = camera_calibration_table(kTableBoard, run);
  for (const char* text :
       {"chess board of 10 x 7 squares of 30 mm, 4 shots\n", "left out: d.dng: no board\n",
        "left out: a corner of b.dng at (12.2, 34.5): 3.50 px off\n", "f   500.000  0.100  px\n",
        "cx  240.500  0.100  px\n",
        "residuals of 4 corners in 3 views: rms 0.125 px, worst 0.500 px (b.dng)\n",
        "a ray's image is known to 0.25 px (std) at the frame's worst corner\n", "0.1250",
        "0.1300  chosen\n", "-  not settled\n", "warning: few views\n"}) {
    EXPECT_THAT(table, HasSubstr(text));
  }
  EXPECT_THAT(table, Not(HasSubstr("times as much as the noise")));
  run.calibration.widened = true;
  run.calibration.view_scatter = 4.0;  // in variance
  EXPECT_THAT(camera_calibration_table(kTableBoard, run),
              HasSubstr("the views differ 2.0 times as much as the noise"));
  // Refused: what was left out, and no number.
  run.calibration.status = calib::CameraCalibrationStatus::kTooFewViews;
  EXPECT_EQ(camera_calibration_table(kTableBoard, run),
            "chess board of 10 x 7 squares of 30 mm, 4 shots\n"
            "left out: d.dng: no board\n"
            "left out: a corner of b.dng at (12.2, 34.5): 3.50 px off\n");
}

TEST(CalibrationTables, Led) {
  calib::LedCalibration c;
  c.light = "led1";
  c.shots.grids = {{"low.dng", 0, 4, 3}};
  calib::LedFit& fit = c.fit;
  fit.status = calib::LedStatus::kOk;
  fit.led.position_mm = {30, -60, 80};
  fit.led.axis = {0, 0, -1};
  fit.led.exponent = 1.25;
  fit.led.intensity_W_per_sr = {0.05, 0.06, 0.04};
  fit.distance_mm = 104.5;
  fit.distance_std_mm = 0.25;
  for (Eigen::Index i = 0; i < kLedParameters; ++i) {
    fit.uncertainty.covariance(i, i) = i < 3 ? 0.04 : 0.0001;
  }
  fit.highlight_used = {true, false, true};
  fit.highlight_rms_px = 0.125;
  fit.highlight_worst_px = 0.25;
  fit.cell_used = {true, true};
  fit.plane_rms = 0.0025;
  fit.plane_worst = 0.01;
  fit.lobe_fitted = true;
  fit.ambient = {{0, {}, {0.01, std::nan(""), 0.02}, {0.001, 0.0, 0.002}}};
  EXPECT_EQ(
      led_calibration_table(c),
      "led1            value      std  unit\n"
      "position x    30.0000   0.2000  mm\n"
      "position y   -60.0000   0.2000  mm\n"
      "position z    80.0000   0.2000  mm\n"
      "distance     104.5000   0.2500  mm\n"
      "axis x        0.00000  0.01000\n"
      "axis y        0.00000  0.01000\n"
      "axis z       -1.00000  0.00000\n"
      "exponent      1.25000  0.01000\n"
      "intensity R      0.05   0.0005  W/sr\n"
      "intensity G      0.06   0.0006  W/sr\n"
      "intensity B      0.04   0.0004  W/sr\n"
      "highlights: 2 of 3 used, residual rms 0.125 px, worst 0.250 px\n"
      "plane: 2 of 2 cells used, residual rms 0.250 %, worst 1.000 %\n"
      "ambient light of low.dng: R 1.000 +- 0.100 % B 2.000 +- 0.200 % of the LED's, fitted\n");
  EXPECT_EQ(led_calibration_verdict(c),
            "The position is known to 0.35 mm, the axis to 0.81 degrees, the intensity to 1 %.");
  fit.lobe_fitted = false;
  EXPECT_THAT(led_calibration_verdict(c),
              ::testing::StartsWith("The position is known to 0.35 mm; axis, exponent"));
  fit.status = calib::LedStatus::kMisfit;
  fit.message = "the plane is no plane";
  EXPECT_THAT(led_calibration_table(c),
              ::testing::StartsWith("led1: refused: the plane is no plane\nhighlights: 2 of 3"));
}

TEST(CalibrationTables, Radiance) {
  capture::RadianceCalibration made;
  capture::RadianceCorrection& c = made.correction;
  c.black_counts = {64, 64, 65, 65};
  c.dark_counts_per_s = {1, 2, 3, 4};
  c.black_std_counts = 0.05;
  c.defect_pixels = {1, 5};
  c.noise.fill({6.0, 1.2});
  made.gain_std_e_per_count.fill(0.1);
  made.read_noise_std_counts.fill(0.02);
  c.response.fill(ResponseCurve({3000.0}, {0.01}));
  made.response_covariance.fill({1e-6});
  c.shutter = {{0.25, 1.02, 0.001}};
  c.vignetting = vignetting_of_frame(120, 80);
  c.vignetting.radial.fill({-0.25});
  c.vignetting_std = 0.002;
  c.glare_share = {0.01, 0.02, 0.03};
  c.glare_std.fill(0.001);
  made.responsivity = {2.4e10, 2.9e10, 2.1e10};
  made.responsivity_relative_std = 0.01;
  made.residuals = {{"flats", 0.2, 0.9, 0.3, "%"}, {"noise", 2.0, 3.0, 1.0, "counts"}};
  made.notes = {"a note"};
  const std::string table = radiance_calibration_table(made);
  const auto row = [&](const std::string& what) {
    const std::size_t at = table.find(what);
    if (at == std::string::npos) return what + " is not there";
    std::string line = table.substr(at, table.find('\n', at) - at);
    std::string out;
    for (const char ch : line) {
      if (ch != ' ' || out.empty() || out.back() != ' ') out += ch;
    }
    return out;
  };
  EXPECT_EQ(row("black "), "black 64.5 0.05 counts");
  EXPECT_EQ(row("dark current"), "dark current 2.5 counts/s");
  EXPECT_EQ(row("defect pixels"), "defect pixels 2");
  EXPECT_EQ(row("gain B"), "gain B 6 0.1 e/count");
  EXPECT_EQ(row("read noise G"), "read noise G 1.2 0.02 counts");
  // It records 1 % too little, known to 0.1 %.
  EXPECT_EQ(row("departure"), "departure at 3000 counts -1 0.1 %");
  EXPECT_EQ(row("time stated"), "time stated 0.25 s 0.255 0.00026 s");
  // 1 - 0.25 (59.5^2 + 39.5^2) / (60^2 + 40^2).
  EXPECT_EQ(row("light in the corner R"), "light in the corner R 75.478 0.2 % of the centre's");
  EXPECT_EQ(row("veiling glare G"), "veiling glare G 2 0.1 % of the frame's mean");
  EXPECT_EQ(row("responsivity R"), "responsivity R 2.4e+10 2.4e+08 counts mm^2 sr/(W s)");
  EXPECT_EQ(row("flats"), "flats 0.2 0.9 0.3 %");
  EXPECT_THAT(table, HasSubstr("EXCEEDED"));
  EXPECT_THAT(table, ::testing::EndsWith("note: a note\n"));
  made.responsivity.reset();
  EXPECT_THAT(radiance_calibration_table(made), Not(HasSubstr("responsivity")));
}

}  // namespace
}  // namespace scattermeter::apps
