#include "apps/simulation/simulate.h"

#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "apps/rig/open_objects.h"
#include "apps/simulation/virtual_shots.h"
#include "calib/pose/shot_pose.h"
#include "capture/raw/raw_reader.h"
#include "capture/raw/tiff_layout.h"
#include "core/base/input_error.h"
#include "tests/fixtures/apps/small_rig.h"
#include "tests/fixtures/apps/yaml_text.h"

namespace scattermeter::apps {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class Simulate : public ::testing::Test {
 protected:
  Simulate() {
    files_.keep_shots("PE_cube");
    rig_ = read_rig(files_.rig());
  }
  std::vector<std::string> made(const SimulateOptions& options = {}) const {
    return simulate(rig_, files_.shots(), options).paths;
  }
  std::string file(const std::string& name) const { return files_.shots() + "/" + name; }
  SmallRig files_;
  Rig rig_;
};

TEST_F(Simulate, FilesAreTheVirtualShots) {
  SimulateOptions options;
  options.seed = 7;
  rig_.scene.shots[1].more_files = {"second.dng"};
  rig_.scene.shots[1].exposure_s = 0.05;
  rig_.scene.shots[1].more_exposures_s = {0.01};
  EXPECT_THAT(made(options),
              ElementsAre(file("PE_cube_1.dng"), file("PE_cube_2.dng"), file("second.dng")));
  const ObjectScenes scenes = open_objects(rig_);
  const VirtualShots shots(rig_, scenes, {.noise = true});
  EXPECT_TRUE(capture::read_raw(file("PE_cube_1.dng")).samples == shots.frame(0, 7).samples);
  EXPECT_TRUE(capture::read_raw(file("PE_cube_2.dng")).samples == shots.frame(1, 7).samples);
  const capture::RawFrame second = capture::read_raw(file("second.dng"));
  EXPECT_TRUE(second.samples == shots.frame(1, 7, 1).samples);
  EXPECT_NEAR(second.exposure_s, 0.01, 1e-6);
}

// What no raw file can hold, and a time that none is exposed for, are named with their field.
TEST_F(Simulate, RefusesWhatNoShotHas) {
  const auto says = [](const std::string& field, const std::string& value) {
    return ::testing::ThrowsMessage<InputError>(
        ::testing::AllOf(HasSubstr(field), HasSubstr(value)));
  };
  Rig given = rig_;
  rig_.scene.camera.intrinsics.width_px -= 1;
  EXPECT_THAT([&] { made(); }, says("camera.image_size_px", "even sides"));
  rig_ = given;
  for (SceneShot& shot : rig_.scene.shots) shot.exposure_s.reset();
  rig_.scene.camera.exposure_s.reset();
  for (double& r : rig_.scene.camera.responsivity.value()) r *= 1e-20;
  EXPECT_THAT([&] { made(); }, says("camera.exposure_s", "responsivity"));
}

// A NEF has the tone curve of its camera; what it cannot hold is refused by name, before any work.
TEST_F(Simulate, NefOfAD80) {
  SimulateOptions options;
  options.format = capture::RawFormat::kNef;
  made(options);
  rig_.scene.camera.sensor.nef_lossy_curve = true;
  const ObjectScenes scenes = open_objects(rig_);
  const VirtualShots shots(rig_, scenes, {.noise = true});
  const capture::RawFrame frame = capture::read_raw(file("PE_cube_1.dng"));
  EXPECT_TRUE(frame.samples == shots.frame(0, 1).samples);
  EXPECT_EQ(frame.model, "D80");
  EXPECT_EQ(capture::tiff_layout(file("PE_cube_1.dng")).is_dng, false);
  rig_.scene.camera.sensor.white_counts = 4000;
  EXPECT_THAT(refusal_of([&] { made(options); }), HasSubstr("camera.sensor.white_counts: is 4000"));
  rig_.scene.camera.model = "Canon EOS 5D";
  EXPECT_THAT(refusal_of([&] { made(options); }), HasSubstr("camera.model: is Canon EOS 5D"));
}

// Shots of the scene and of the calibrations, either of which may be left out.
TEST_F(Simulate, PartsOfTheRig) {
  rig_.scene.shots.resize(1);
  calib::BoardShots& board = rig_.calibration.camera.emplace();
  board.board = {calib::BoardKind::kChessboard, 6, 5, 5.0, 0.0, ""};
  board.shots.resize(1);
  board.shots[0].file = "board.dng";
  board.shots[0].viewpoint = {{15, 12, 200}, {15, 12, 0}, {0, 1, 0}};
  SimulateOptions options;
  EXPECT_THAT(made(options), ElementsAre(file("PE_cube_1.dng"), file("board.dng")));
  options.scene = false;
  EXPECT_THAT(made(options), ElementsAre(file("board.dng")));
  options.calibration = false;
  EXPECT_TRUE(made(options).empty());
  options.scene = true;
  EXPECT_THAT(made(options), ElementsAre(file("PE_cube_1.dng")));
}

// The board has a shot of its own and is in no other: the pose that it gives is the truth.
TEST_F(Simulate, BoardInAShotOfItsOwn) {
  rig_.scene.shots.resize(1);
  calib::CharucoBoard board;
  board.squares_x = 10;
  board.squares_y = 8;
  board.square_mm = 6.0;
  board.marker_mm = 4.5;
  board.dictionary = "DICT_4X4_100";
  board.world_from_board.translation_mm = {-30, -22, 0};
  rig_.pose.points.clear();
  rig_.pose.charuco = board;
  rig_.pose.board_shot = "board.dng";
  EXPECT_THAT(refusal_of([&] { made(); }), HasSubstr("truth.pose: is missing"));
  rig_.truth.pose = CameraPlacement{{0, -100, 150}, {0, 0, 9}};
  SimulateOptions options;
  options.noise = false;
  EXPECT_THAT(made(options), ElementsAre(file("board.dng"), file("PE_cube_1.dng")));
  const capture::RawFrame frame = capture::read_raw(file("board.dng"));
  EXPECT_TRUE(frame.samples == board_frame(rig_).samples);
  // A corner of the frame of the cube's shot, where the board would be, is black.
  EXPECT_EQ(capture::read_raw(file("PE_cube_1.dng")).at(60, 160), 64);
  const PoseResult pose = calib::pose_from_board(rig_.scene, rig_.pose, frame, "board.dng");
  EXPECT_EQ(pose.status, PoseStatus::kOk);
  EXPECT_NEAR(
      (inverse(pose.camera_from_world).translation_mm - Eigen::Vector3d(0, -100, 150)).norm(), 0.0,
      0.5);
}

// A camera's file of a shot's name stays; files that it made itself are made again.
TEST_F(Simulate, KeepsTheFilesOfACamera) {
  std::filesystem::create_directories(files_.shots());
  write_file(file("PE_cube_2.dng"), std::string("from a camera"));
  EXPECT_THAT(refusal_of([&] { made(); }), HasSubstr("PE_cube_2.dng: exists and is not from"));
  EXPECT_EQ(slurp(file("PE_cube_2.dng")), "from a camera");
  std::filesystem::remove(file("PE_cube_2.dng"));
  EXPECT_EQ(made().size(), 2U);
  EXPECT_EQ(made().size(), 2U);
}

TEST_F(Simulate, AFolderThatCannotBeMade) {
  write_file(files_.shots(), std::string("a file"));
  EXPECT_THAT(refusal_of([&] { made(); }), HasSubstr(files_.shots()));
}

}  // namespace
}  // namespace scattermeter::apps
