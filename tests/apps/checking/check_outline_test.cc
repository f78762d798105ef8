#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/apps/made_checked_rig.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

class CheckOutline : public ::testing::Test {
 protected:
  CheckOutline() : made_(2) {
    EXPECT_TRUE(check_outline(made_.checked).empty());
    outline_ = &made_.checked.outline.emplace();
    outline_->shots.resize(2);
    outline_->shots[0].found = true;
    outline_->shots[0].shift_px = {0.3, -0.4};
    outline_->shots[0].shift_std_px = {0.06, 0.08};
    outline_->shots_found = 1;
    outline_->diagnosis.agrees = true;
    outline_->diagnosis.verdict = "the lens is longer";
    outline_->drift_verdict = "camera moved";
    made_.checked.shared_pose.emplace();
  }
  MadeCheckedRig made_;
  calib::SilhouetteCheck* outline_ = nullptr;
};

TEST_F(CheckOutline, ShiftsOfThoseFound) {
  const std::vector<CheckItem> items = check_outline(made_.checked);
  ASSERT_EQ(items.size(), 2U);
  EXPECT_EQ(items[0].what, "outline");
  EXPECT_TRUE(items[0].passed);
  ASSERT_EQ(items[0].details.size(), 1U);
  EXPECT_EQ(items[0].where, "a.dng");
  EXPECT_NEAR(items[0].worst, 0.5, 1e-12);
  EXPECT_NEAR(items[0].details[0].std, 0.1, 1e-12);
  EXPECT_EQ(items[1].what, "camera between shots");
  EXPECT_TRUE(items[1].passed);
}

TEST_F(CheckOutline, ADiagnosisCountsWhereItIsLargeEnough) {
  outline_->diagnosis.agrees = false;
  CheckItem item = check_outline(made_.checked)[0];
  EXPECT_FALSE(item.passed);
  EXPECT_EQ(item.advice, "the lens is longer");
  outline_->shots[0].shift_px = {0.1, 0.0};
  EXPECT_TRUE(check_outline(made_.checked)[0].passed);
  outline_->rms_px = 0.51;  // rough all over
  EXPECT_FALSE(check_outline(made_.checked)[0].passed);
}

// The object may stand elsewhere by as much as the rig states.
TEST_F(CheckOutline, WithinTheStatedPosition) {
  outline_->diagnosis.agrees = false;
  OutlineFindings& looks = made_.checked.looks.emplace();
  EXPECT_FALSE(check_outline(made_.checked)[0].passed);
  looks.shifts["cube"] = PoseShift::Zero();
  EXPECT_TRUE(check_outline(made_.checked)[0].passed);
  looks.findings.push_back({"mesh displaced", "it lies elsewhere", "put it back", {}});
  EXPECT_FALSE(check_outline(made_.checked)[0].passed);
  // Before a board, where the search of the outline did not reach that far.
  outline_->shots_found = 0;
  made_.checked.shared_pose.reset();
  const CheckItem item = check_outline(made_.checked)[0];
  EXPECT_FALSE(item.passed);
  EXPECT_EQ(item.advice, "it lies elsewhere; put it back");
}

TEST_F(CheckOutline, Drift) {
  outline_->drifts = true;
  outline_->drift_px = 0.1;
  EXPECT_TRUE(check_outline(made_.checked)[1].passed);
  outline_->drift_px = 0.2;
  const CheckItem item = check_outline(made_.checked)[1];
  EXPECT_FALSE(item.passed);
  EXPECT_EQ(item.worst, 0.2);
  EXPECT_EQ(item.advice, "camera moved");
  // A board moves along with the camera.
  made_.checked.shared_pose.reset();
  EXPECT_EQ(check_outline(made_.checked).size(), 1U);
}

TEST_F(CheckOutline, NoneFound) {
  outline_->shots_found = 0;
  outline_->shots[0].found = false;
  outline_->diagnosis.agrees = false;
  std::vector<CheckItem> items = check_outline(made_.checked);
  ASSERT_EQ(items.size(), 1U);
  EXPECT_FALSE(items[0].passed);
  EXPECT_THAT(items[0].advice, HasSubstr("not found"));
  // A round body's may end in the dark.
  const SceneObject stated;
  ObjectScene round;
  round.stated = &stated;
  round.is_round = true;
  const auto seen = std::make_shared<SeenObject>();
  seen->object = &round;
  std::vector<ObservedShot> cubes = made_.checked.shots;
  made_.checked.shots.assign(2, {});
  for (ObservedShot& shot : made_.checked.shots) shot.seen = seen;
  EXPECT_TRUE(check_outline(made_.checked)[0].passed);
  made_.checked.shots = std::move(cubes);
  // Not enough straight edges, but the contour was seen where it belongs, or elsewhere.
  OutlineFindings& looks = made_.checked.looks.emplace();
  looks.diagnosis.emplace();
  looks.diagnosis->shift_px = {0.3, 0.4};
  looks.diagnosis->shift_std_px = 0.2;
  looks.diagnosis->explanations.resize(2);
  looks.diagnosis->explanations[1].text = "mesh of cube displaced";
  looks.looked_at = {0, 1};
  items = check_outline(made_.checked);
  EXPECT_TRUE(items[0].passed);
  EXPECT_NEAR(items[0].worst, 0.5, 1e-12);
  looks.diagnosis->agrees = false;
  EXPECT_FALSE(check_outline(made_.checked)[0].passed);
  EXPECT_EQ(check_outline(made_.checked)[0].advice, "mesh of cube displaced");
  // Before a board the outline is not judged.
  made_.checked.shared_pose.reset();
  EXPECT_TRUE(check_outline(made_.checked)[0].passed);
}

}  // namespace
}  // namespace scattermeter::apps
