#include "calib/lens/calibrate_camera.h"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "apps/rig/rig.h"
#include "calib/lens/camera_calibration_file.h"
#include "tests/fixtures/apps/board_rig.h"

namespace scattermeter::apps {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(CalibrateCamera, OpenCvsChessboards) {
  const char* shared = std::getenv("SCATTERMETER_SHARED");
  const std::string folder =
      std::string(shared != nullptr ? shared : SCATTERMETER_SHARED_DEFAULT) + "/data/chessboard";
  if (!fs::exists(folder)) {
    GTEST_SKIP() << folder << " is not there; set SCATTERMETER_SHARED to the folder with "
                 << "data/chessboard";
  }
  calib::CalibrateCameraOptions options;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (entry.path().filename().string().starts_with("left")) {
      options.shots.push_back(entry.path().string());
    }
  }
  options.board = {calib::BoardKind::kChessboard, 10, 7, 30};
  const calib::CameraCalibrationRun run = calib::calibrate_camera_shots(options);
  ASSERT_EQ(run.calibration.status, calib::CameraCalibrationStatus::kOk);
  EXPECT_EQ(run.calibration.views.size(), 13U);
  EXPECT_NEAR(run.calibration.intrinsics.fx_px, 532.8, 1);
  EXPECT_NEAR(run.calibration.intrinsics.fy_px, 532.8, 1);
  EXPECT_LE(run.calibration.rms_px, 0.20);
  const TemporaryFolder out;
  write_file(out / "camera.yaml", calib::camera_calibration_text(run.calibration, {}));
  EXPECT_EQ(calib::read_camera_calibration_file(out / "camera.yaml").covariance,
            run.calibration.covariance);
}

// The whole road, for either board: what `simulate` shot, `calibrate` finds, a rig takes it.
TEST(CalibrateCamera, RawsBackToTheTruth) {
  for (const char* board : {kChess, kCharuco}) {
    const BoardRig rig(board, 1);
    rig.shoot(1);
    const Answer a = rig.calibrate({"--rig", rig.rig()});
    ASSERT_EQ(a.status, 0) << a.out << a.err;
    EXPECT_THAT(a.out, AllOf(HasSubstr("residuals of"), HasSubstr("chosen"), HasSubstr("written")));
    const calib::CameraCalibrationFile file = calib::read_camera_calibration_file(rig.file());
    EXPECT_NEAR(file.intrinsics.fx_px, 520, 4 * std::sqrt(file.covariance(0, 0)));
    EXPECT_LT(std::sqrt(file.covariance(0, 0)), 3);
    EXPECT_LT(file.rms_px, 0.25);
    EXPECT_TRUE(fs::exists(rig / "camera.html"));
    EXPECT_TRUE(fs::exists(rig / "camera_residuals.png") || a.out.find("gnuplot") != a.out.npos);
    const std::string other = rig / "other.yaml";
    std::ofstream(other) << replaced(rig.text(),
                                     "{fx_px: 520, fy_px: 520, cx_px: 243.1, cy_px: 159.4, "
                                     "distortion: [-0.12, 0.05, 0, 0]}",
                                     "camera.yaml");
    EXPECT_EQ(read_rig(other).scene.camera.intrinsics.fx_px, file.intrinsics.fx_px);
  }
}

// 8 x 6 squares have 7 x 5 inner corners.
TEST(CalibrateCamera, SquaresAndCornersExchanged) {
  const BoardRig rig(kChess, 3);
  rig.shoot(1);
  for (const auto& [option, count] : {std::pair("--squares", "7x5"), {"--corners", "8x6"}}) {
    const Answer a = rig.calibrate({"--board", "chessboard", option, count, "--square-mm", "30"});
    EXPECT_EQ(a.status, 1) << a.out;
    EXPECT_THAT(a.err, HasSubstr("shows a board of 8 x 6 squares, which has 7 x 5 inner corners: "
                                 "one was given for the other"));
  }
}

TEST(CalibrateCamera, LeavesOutWhatDoesNotBelong) {
  const BoardRig rig(kChess, 3);
  rig.shoot(1);
  std::ofstream(rig.shots() + "/notes.txt") << "no picture";
  std::ofstream(rig.shots() + "/other.pgm", std::ios::binary) << "P5 64 64 255\n"
                                                              << std::string(64 * 64, '\7');
  fs::copy(rig.shots() + "/board_2.dng", rig.shots() + "/copy.dng");
  const Answer a =
      rig.calibrate({"--board", "chessboard", "--corners", "7x5", "--square-mm", "30"});
  ASSERT_EQ(a.status, 0) << a.err;
  EXPECT_THAT(a.out, AllOf(HasSubstr("left out: notes.txt: is no raw file"),
                           HasSubstr("left out: other.pgm: 64 x 64 px, not 484 x 324 px"),
                           HasSubstr("left out: copy.dng: the same shot as board_2.dng")));
}

TEST(CalibrateCamera, RefusesWithItsReasonAndWritesNothing) {
  const BoardRig flat(kChess, 4, 6, 0.0, 0.0);
  flat.shoot(1);
  const Answer parallel = flat.calibrate({"--rig", flat.rig()});
  EXPECT_EQ(parallel.status, 1);
  EXPECT_THAT(parallel.err, AllOf(HasSubstr("refused"), HasSubstr("tilt the board")));
  EXPECT_FALSE(fs::exists(flat.file()));
  // Other squares than the board has.
  const Answer squares =
      flat.calibrate({"--board", "chessboard", "--squares", "9x7", "--square-mm", "30"});
  EXPECT_EQ(squares.status, 1);
  EXPECT_THAT(squares.err, HasSubstr("check the board's kind, squares"));
  EXPECT_FALSE(fs::exists(flat.file()));
}

TEST(CalibrateCamera, BadInputIsNamed) {
  BoardRig rig(kChess, 5);
  const auto error = [&](const std::vector<std::string>& more) {
    const Answer a = rig.calibrate(more);
    EXPECT_EQ(a.status, 2) << a.err;
    return a.err;
  };
  EXPECT_THAT(error({"--rig", rig.rig()}), HasSubstr("board_0.dng"));  // not shot yet
  EXPECT_THAT(error({}), HasSubstr("--board"));
  EXPECT_THAT(error({"--board", "chessboard", "--square-mm", "3"}), HasSubstr("--squares"));
  EXPECT_THAT(error({"--board", "chessboard", "--square-mm", "3", "--squares", "10by7"}),
              HasSubstr("10by7"));
  EXPECT_THAT(error({"--board", "chessboard", "--square-mm", "3", "--squares", "3x7"}),
              HasSubstr("at least 4 x 4"));
  EXPECT_THAT(error({"--board", "chessboard", "--square-mm", "3", "--squares", "10x7"}),
              HasSubstr("empty"));
  const std::string good = rig.text();
  rig.write(replaced(good, "type: chessboard", "type: checkers"));
  EXPECT_THAT(error({"--rig", rig.rig()}), HasSubstr("calibration.camera.board.type"));
  rig.write(replaced(good, "file: board_1.dng", "file: board_0.dng"));
  EXPECT_THAT(error({"--rig", rig.rig()}), HasSubstr("two shots of the same name"));
}

}  // namespace
}  // namespace scattermeter::apps
