#include "apps/rig/rig_camera_calibration.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/apps/yaml_text.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

constexpr const char* kBoardSection =
    "board: {type: charuco, squares: [8, 6], square_mm: 30, marker_mm: 22, dictionary: "
    "DICT_5X5_100}\n"
    "board_std_mm: 0.05\n"
    "shots:\n"
    "  - {file: a.dng}\n"
    "  - {file: b.dng, position_mm: [0, -100, 300], look_at_mm: [120, 90, 0], up: [0, 5, 0]}\n";

std::string camera_calibration_refused(const std::string& text) {
  return refusal_of([&] { read_camera_calibration(yaml_text(text), "rig.yaml"); });
}

TEST(RigCameraCalibration, ReadsBoardAndShots) {
  const calib::BoardShots c = read_camera_calibration(yaml_text(kBoardSection), "a/rig.yaml");
  EXPECT_EQ(c.board.kind, calib::BoardKind::kCharuco);
  EXPECT_EQ(c.board.squares_x, 8);
  EXPECT_EQ(c.board.squares_y, 6);
  EXPECT_EQ(c.board.square_mm, 30.0);
  EXPECT_EQ(c.board.marker_mm, 22.0);
  EXPECT_EQ(c.board.dictionary, "DICT_5X5_100");
  EXPECT_EQ(c.board_std_mm, 0.05);
  ASSERT_EQ(c.shots.size(), 2U);
  EXPECT_EQ(c.shots[0].file, "a.dng");
  EXPECT_FALSE(c.shots[0].viewpoint.has_value());
  EXPECT_EQ(c.at(c.shots[0].line), "a/rig.yaml:4");
  ASSERT_TRUE(c.shots[1].viewpoint.has_value());
  EXPECT_EQ(c.shots[1].viewpoint->position_mm, Eigen::Vector3d(0, -100, 300));
  EXPECT_EQ(c.shots[1].viewpoint->look_at_mm, Eigen::Vector3d(120, 90, 0));
  EXPECT_EQ(c.shots[1].viewpoint->up, Eigen::Vector3d::UnitY());
}

TEST(RigCameraCalibration, AChessboardHasNoMarkers) {
  const std::string shots = "shots: [{file: a.dng}]\n";
  const calib::BoardShots c = read_camera_calibration(
      yaml_text("board: {type: chessboard, squares: [9, 7], square_mm: 25}\n" + shots), "rig.yaml");
  EXPECT_EQ(c.board.kind, calib::BoardKind::kChessboard);
  EXPECT_EQ(c.board_std_mm, 0.0);
  EXPECT_THAT(
      camera_calibration_refused(
          "board: {type: chessboard, squares: [9, 7], square_mm: 25, marker_mm: 9}\n" + shots),
      HasSubstr("board.marker_mm: unknown key"));
  // Three squares in a row have two inner corners.
  EXPECT_THAT(camera_calibration_refused(
                  "board: {type: chessboard, squares: [9, 3], square_mm: 25}\n" + shots),
              HasSubstr("rig.yaml:1: board"));
}

TEST(RigCameraCalibration, NamesWhatIsWrong) {
  const auto refused = [](const std::string& from, const std::string& to) {
    std::string text = kBoardSection;
    return camera_calibration_refused(text.replace(text.find(from), from.size(), to));
  };
  EXPECT_THAT(refused("type: charuco", "type: dots"), HasSubstr("expected chessboard or charuco"));
  EXPECT_THAT(refused("marker_mm: 22", "marker_mm: 31"), HasSubstr("board"));
  EXPECT_THAT(refused("board_std_mm: 0.05", "board_std_mm: 31"), HasSubstr("board_std_mm"));
  EXPECT_THAT(refused("b.dng", "a.dng"), HasSubstr("shots[1].file: two shots of the same name"));
  EXPECT_THAT(refused(", look_at_mm: [120, 90, 0]", ""), HasSubstr("look_at_mm: is missing"));
  // Straight down along its own up.
  EXPECT_THAT(refused("look_at_mm: [120, 90, 0]", "look_at_mm: [0, 50, 300]"),
              HasSubstr("shots[1]: position_mm, look_at_mm and up do not define a camera"));
  EXPECT_THAT(camera_calibration_refused(
                  "board: {type: chessboard, squares: [9, 7], square_mm: 25}\nshots: []\n"),
              HasSubstr("shots: expected at least one shot"));
}

// The rig that is to be calibrated has no lens yet; what else is in it is not looked at.
TEST(RigCameraCalibration, TheRigNeedNotBeComplete) {
  const TemporaryFolder folder;
  const std::string path = folder / "rig.yaml";
  const std::string rig =
      "scattermeter_rig: 1\n"
      "limits: {raw_megapixels: 0.2}\n"
      "camera: {model: NIKON D80, image_size_px: [484, 324], intrinsics: not_there.yaml}\n"
      "calibration:\n"
      "  camera:\n"
      "    board: {type: chessboard, squares: [9, 7], square_mm: 25}\n"
      "    shots: [{file: a.dng}, {file: b.dng}]\n";
  write_file(path, rig);
  const RigCameraToCalibrate camera = read_camera_to_calibrate(path);
  EXPECT_EQ(camera.model, "NIKON D80");
  EXPECT_EQ(camera.width_px, 484);
  EXPECT_EQ(camera.height_px, 324);
  EXPECT_EQ(camera.max_megapixels, 0.2);
  EXPECT_EQ(camera.calibration.shots.size(), 2U);
  EXPECT_EQ(camera.calibration.path, path);
  write_file(path, std::string(rig).replace(rig.find("0.2"), 3, "0.1"));
  EXPECT_THAT(refusal_of([&] { read_camera_to_calibrate(path); }),
              HasSubstr("camera.image_size_px: more than the allowed 0.1 megapixels"));
  write_file(path, std::string(rig).replace(rig.find("rig: 1"), 6, "rig: 2"));
  EXPECT_THAT(refusal_of([&] { read_camera_to_calibrate(path); }), HasSubstr("version 1"));
  write_file(path, rig.substr(0, rig.find("calibration:")));
  EXPECT_THAT(refusal_of([&] { read_camera_to_calibrate(path); }),
              HasSubstr("calibration: is missing"));
}

}  // namespace
}  // namespace scattermeter::apps
