#include "apps/simulation/simulate_camera_calibration.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "apps/simulation/board_signal.h"
#include "capture/raw/raw_reader.h"
#include "tests/fixtures/apps/overhead_view.h"
#include "tests/fixtures/apps/yaml_text.h"

namespace scattermeter::apps {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class CameraShots : public ::testing::Test {
 protected:
  CameraShots() {
    rig_.path = "rig.yaml";
    rig_.scene.camera.intrinsics = overhead_view(0, 0).intrinsics;
    rig_.scene.camera.responsivity = {2.4e10, 2.9e10, 2.1e10};
    rig_.scene.camera.sensor.noise = {6.0, 1.2};
    calib::BoardShots& board = rig_.calibration.camera.emplace();
    board.board = {calib::BoardKind::kChessboard, 6, 5, 20.0, 0.0, ""};
    board.shots.resize(2);
    board.shots[0].file = "a.dng";
    board.shots[1].file = "b.dng";
    board.shots[1].line = 7;
    for (calib::BoardShot& shot : board.shots) {
      shot.viewpoint = {{60, 50, 400}, {60, 50, 0}, {0, 1, 0}};
    }
  }
  calib::BoardShot& shot() { return rig_.calibration.camera->shots[1]; }
  Rig rig_;
};

// White in full light, on the margin left of the print: 0.7 of 4095 - 64 in green, the others in
// the proportion of the responsivity; nothing is brighter.
TEST_F(CameraShots, WhiteIsAtSevenTenths) {
  const std::vector<float> counts = board_shot_counts(rig_, shot());
  const CameraView view = overhead_view(60, 50);
  std::array<int, 3> seen{};
  for (int y = 0; y < 200; ++y) {
    for (int x = 0; x < 240; ++x) {
      const Eigen::Vector3d p = overhead_point_mm(view, x, y);
      const auto c = static_cast<std::size_t>(rig_.scene.camera.sensor.cfa.at(x, y));
      const double white = 0.7 * 4031.0 * (*rig_.scene.camera.responsivity)[c] / 2.9e10;
      const double value = counts[static_cast<std::size_t>(y * 240 + x)];
      ASSERT_LT(value, white * 1.00001);
      if (p.x() < -17 || p.x() > -3 || p.y() < 5 || p.y() > 95) continue;
      ASSERT_NEAR(value, white, 0.001 * white);
      ++seen[c];
    }
  }
  EXPECT_GT(std::min({seen[0], seen[1], seen[2]}), 100);
}

TEST_F(CameraShots, EachIsAFile) {
  const TemporaryFolder folder;
  SimulateOptions options;
  options.noise = false;
  rig_.scene.camera.exposure_s = 0.25;
  EXPECT_THAT(simulate_camera_calibration(rig_, folder.path(), options, nullptr),
              ElementsAre(folder / "a.dng", folder / "b.dng"));
  const capture::RawFrame read = capture::read_raw(folder / "b.dng");
  EXPECT_NEAR(read.exposure_s, 0.25, 1e-6);
  const std::vector<float> counts = board_shot_counts(rig_, shot());
  for (std::size_t i = 0; i < counts.size(); ++i) {
    ASSERT_NEAR(read.samples[i] - 64.0, static_cast<double>(counts[i]), 0.5001);
  }
  rig_.calibration.camera.reset();
  EXPECT_TRUE(simulate_camera_calibration(rig_, folder.path(), options, nullptr).empty());
}

TEST_F(CameraShots, NamesWhatIsWrong) {
  const auto refused = [&] { return refusal_of([&] { board_shot_counts(rig_, shot()); }); };
  shot().viewpoint = {{60, 50, -400}, {60, 50, 0}, {0, 1, 0}};
  EXPECT_THAT(refused(), HasSubstr("rig.yaml:7: calibration.camera.shots: the board is not in view "
                                   "of b.dng, or seen from behind"));
  shot().viewpoint = {{60, 50, 400}, {60, 50, 800}, {0, 1, 0}};
  EXPECT_THAT(refused(), HasSubstr("not in view"));
  shot().viewpoint.reset();
  EXPECT_THAT(refused(), HasSubstr("rig.yaml:7: calibration.camera.shots.position_mm: is missing"));
}

}  // namespace
}  // namespace scattermeter::apps
