#include "calib/pose/outline_causes.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/mesh/bodies.h"
#include "tests/fixtures/calib/painted_body.h"

namespace scattermeter::calib {
namespace {

using ::testing::HasSubstr;

// A cube and a pyramid, each painted in one shot or two.
class OutlineCausesTest : public ::testing::Test {
 protected:
  OutlineCausesTest() {
    pose_.camera_from_world = outline_view();
    know_pose(0.05);
  }
  void know_pose(double std_mm) {
    pose_.covariance.setZero();
    pose_.covariance.diagonal() << 1e-10, 1e-10, 1e-10, std_mm * std_mm, std_mm * std_mm,
        std_mm * std_mm;
  }
  void add(int body, const Eigen::Vector3d& moved_mm, const RayScene& shown) {
    contours_[body] = contour_points(scenes_[body], lens_, pose_.camera_from_world, 2);
    shots_.push_back({"abcd"[shots_.size()] + std::string(".dng"), body, &contours_[body],
                      look_at_outline(contours_[body],
                                      painted_body(shown, lens_, pose_.camera_from_world, moved_mm,
                                                   800, 2, shots_.size()),
                                      {6.0, 2.0}),
                      Eigen::Vector3d::Zero()});
  }
  void add(int body, const Eigen::Vector3d& moved_mm) { add(body, moved_mm, scenes_[body]); }
  OutlineDiagnosis explain(double place_std_mm = 0.2) const {
    OutlineOptions options;
    options.place_std_mm = place_std_mm;
    return explain_outlines(shots_, lens_, pose_, {"cube", "pyramid"}, {{0, 0, 10}, {0, 0, 10}},
                            options);
  }

  RayScene scenes_[2] = {RayScene{cube_mesh()}, RayScene{body_mesh("pyramid")}};
  CameraIntrinsics lens_ = outline_lens();
  PoseResult pose_;
  std::vector<ContourPoint> contours_[2];
  std::vector<OutlineShot> shots_;
};

TEST_F(OutlineCausesTest, GoodRig) {
  for (const int body : {0, 1}) {
    shots_.clear();
    add(body, {0, 0, 0});
    const OutlineDiagnosis d = explain();
    EXPECT_TRUE(d.agrees) << d.explanations[1].text;
    EXPECT_TRUE(d.shifts.empty());
    EXPECT_GT(d.fitting_share[0], 0.9);
    EXPECT_LT(d.shift_px.norm(), 0.5);
  }
}

// What might as well be chance is not told, but asks for a closer look.
TEST_F(OutlineCausesTest, MayBeDisplaced) {
  add(0, {0, 0.6, 0});
  const OutlineDiagnosis d = explain(0.1);
  EXPECT_TRUE(d.agrees) << d.explanations[1].text;
  EXPECT_TRUE(may_be_misplaced(d, 0));
  EXPECT_FALSE(may_be_misplaced(d, 1));
  shots_.clear();
  add(0, {0, 0, 0});
  EXPECT_FALSE(may_be_misplaced(explain(0.1), 0));
}

TEST_F(OutlineCausesTest, MeshDisplaced) {
  add(0, {2, 0, 0});
  const OutlineDiagnosis d = explain();
  EXPECT_FALSE(d.agrees);
  EXPECT_EQ(d.explanations[0].cause, OutlineCause::kNone);
  ASSERT_EQ(d.explanations[1].cause, OutlineCause::kMeshDisplaced) << d.explanations[1].text;
  EXPECT_NEAR(d.explanations[1].value[0], 2.0, 0.1);
  EXPECT_THAT(d.explanations[1].text, HasSubstr("mesh of cube displaced"));
}

// Of two bodies only one.
TEST_F(OutlineCausesTest, MeshOfOneDisplaced) {
  add(0, {0, 0, 0});
  add(1, {0, 2, 0});
  const OutlineDiagnosis d = explain();
  EXPECT_FALSE(d.agrees);
  ASSERT_EQ(d.explanations[1].cause, OutlineCause::kMeshDisplaced) << d.explanations[1].text;
  EXPECT_EQ(d.explanations[1].which, 1U);
}

TEST_F(OutlineCausesTest, BothDisplacedAlikeIsTheCamera) {
  add(0, {2, 0, 0});
  add(1, {2, 0, 0});
  const OutlineDiagnosis d = explain();
  EXPECT_FALSE(d.agrees);
  EXPECT_EQ(d.explanations[1].cause, OutlineCause::kCamera) << d.explanations[1].text;
  EXPECT_THAT(d.explanations[1].text, HasSubstr("camera moved"));
}

TEST_F(OutlineCausesTest, MeshScaled) {
  TriangleMesh larger = cube_mesh();
  for (Eigen::Vector3d& v : larger.vertices_mm) {
    v = Eigen::Vector3d(0, 0, 10) + 1.05 * (v - Eigen::Vector3d(0, 0, 10));
  }
  const RayScene shown(larger);
  add(0, {0, 0, 0}, shown);
  const OutlineDiagnosis d = explain();
  EXPECT_FALSE(d.agrees);
  ASSERT_EQ(d.explanations[1].cause, OutlineCause::kMeshScale) << d.explanations[1].text;
  const double scale = d.explanations[1].value[0];
  EXPECT_GT(scale, 0.02);
  EXPECT_LT(std::abs(scale - std::log(1.05)), 3.0 * std::sqrt(d.explanations[1].covariance(0, 0)));
  EXPECT_THAT(d.explanations[1].text, HasSubstr("% larger"));
}

TEST_F(OutlineCausesTest, OneShotMoved) {
  add(0, {0, 0, 0});
  add(0, {0, 0, 0});
  add(0, {1.5, 0, 0});
  const OutlineDiagnosis d = explain();
  EXPECT_FALSE(d.agrees);
  ASSERT_EQ(d.explanations[1].cause, OutlineCause::kShotMoved) << d.explanations[1].text;
  EXPECT_THAT(d.explanations[1].text, HasSubstr("c.dng"));
}

// Within what the rig states: the outline shows where the body stands.
TEST_F(OutlineCausesTest, PoseWithinItsUncertainty) {
  know_pose(1.0);
  const Eigen::Vector3d moved(1, 0, 0);
  add(0, moved);
  const OutlineDiagnosis d = explain(0.0);
  EXPECT_TRUE(d.agrees) << d.explanations[1].text;
  ASSERT_EQ(d.shifts.size(), 2U);
  const Eigen::Vector3d at(0, 0, 10);
  const Eigen::Vector2d true_px = project(lens_, pose_.camera_from_world, {at + moved}).front();
  const Eigen::Vector2d old_px = project(lens_, pose_.camera_from_world, {at}).front();
  const Eigen::Vector2d new_px =
      project(lens_, shifted_pose(pose_.camera_from_world, d.shifts[0]), {at}).front();
  // Most of it; the fit of the shots gives the rest.
  EXPECT_LT((new_px - true_px).norm(), 0.25 * (old_px - true_px).norm());
  EXPECT_LT((d.shift_px - (true_px - old_px)).norm(), 0.25 * (old_px - true_px).norm());
  // With a pose that is known well it is an object out of place.
  know_pose(0.01);
  EXPECT_FALSE(explain(0.0).agrees);
}

}  // namespace
}  // namespace scattermeter::calib
