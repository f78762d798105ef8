#include "apps/looks/outline_finding.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scattermeter::apps {
namespace {

using calib::OutlineCause;
using ::testing::HasSubstr;

calib::OutlineDiagnosis diagnosis_of(const std::vector<OutlineCause>& causes) {
  calib::OutlineDiagnosis d;
  d.agrees = false;
  d.explanations.emplace_back();  // the rig as it is
  for (std::size_t k = 0; k < causes.size(); ++k) {
    calib::OutlineExplanation& e = d.explanations.emplace_back();
    e.cause = causes[k];
    e.text = "cause " + std::to_string(k);
  }
  return d;
}

TEST(OutlineFinding, NamesTheCauseAndTheNextStep) {
  calib::OutlineDiagnosis d =
      diagnosis_of({OutlineCause::kMeshScale, OutlineCause::kMeshDisplaced});
  d.likely = 1;
  const Finding f = outline_finding(d, "cube");
  EXPECT_EQ(f.cause, "mesh scaled");
  EXPECT_EQ(f.text, "cause 0");
  EXPECT_THAT(f.advice, HasSubstr("scale the mesh of objects.cube"));
  EXPECT_TRUE(f.shots.empty());
}

TEST(OutlineFinding, ListsWhatCannotBeToldFromIt) {
  calib::OutlineDiagnosis d =
      diagnosis_of({OutlineCause::kMeshDisplaced, OutlineCause::kMeshTurned,
                    OutlineCause::kMeshMisplaced, OutlineCause::kMeshScale});
  d.likely = 3;
  const Finding f = outline_finding(d, "pyramid");
  EXPECT_EQ(f.cause, "mesh displaced");
  EXPECT_EQ(f.text, "cause 0 (cannot be told from: cause 1, cause 2)");
  EXPECT_THAT(f.advice, HasSubstr("objects.pyramid"));
}

// The camera's distance from a board is known as well as its squares.
TEST(OutlineFinding, ABoardOfAnotherSize) {
  calib::OutlineDiagnosis d = diagnosis_of({OutlineCause::kCamera});
  calib::OutlineExplanation& camera = d.explanations.at(1);
  camera.value = Eigen::VectorXd::Zero(6);
  camera.value.tail<3>() = Eigen::Vector3d(0.3, -0.2, 4.0);
  EXPECT_EQ(outline_finding(d, "").text, "cause 0");
  EXPECT_THAT(outline_finding(d, "", 200.0).text,
              HasSubstr("or the squares of the board are 2.0 % larger than stated"));
  camera.value.tail<3>() = Eigen::Vector3d(3.0, -0.2, 4.0);
  EXPECT_EQ(outline_finding(d, "", 200.0).text, "cause 0");
  EXPECT_THAT(or_of_another_board(0.03), HasSubstr("3.0 % smaller"));
  EXPECT_EQ(or_of_another_board(0.001), "");
}

TEST(OutlineFinding, TheDistanceIsOfABoard) {
  PoseResult pose;
  pose.camera_from_world.translation_mm = {0, 30, 40};
  calib::PoseSource source;
  EXPECT_EQ(board_distance_mm(source, pose), 0.0);
  source.board_shot = "board.dng";
  EXPECT_DOUBLE_EQ(board_distance_mm(source, pose), 50.0);
}

TEST(OutlineFinding, CameraAndShot) {
  EXPECT_THAT(outline_finding(diagnosis_of({OutlineCause::kCamera}), "").advice,
              HasSubstr("pose points again"));
  const Finding f = outline_finding(diagnosis_of({OutlineCause::kShotMoved}), "");
  EXPECT_EQ(f.cause, "shot moved");
  EXPECT_THAT(f.advice, HasSubstr("take this shot again"));
}

}  // namespace
}  // namespace scattermeter::apps
