#include "apps/looks/pose_points.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calib/pose/shot_pose.h"
#include "tests/fixtures/apps/body_rig.h"

namespace scattermeter::apps {
namespace {

// Read 0.6 px off, to either side.
TEST(PosePoints, ScatterByFarMoreThanStated) {
  Rig rig = body_rig("cube", 1);
  for (std::size_t i = 0; i < rig.pose.points.size(); ++i) {
    rig.pose.points[i].image_px.x() += i % 2 == 0 ? 0.6 : -0.6;
  }
  const auto found = [&](double stated_px) {
    rig.pose.options.point_std_px = stated_px;
    return scattered_points(rig, calib::pose_from_points(rig.scene, rig.pose), {0});
  };
  EXPECT_FALSE(found(0.6));
  const std::optional<Finding> finding = found(0.1);
  ASSERT_TRUE(finding);
  EXPECT_EQ(finding->cause, "pose points");
  EXPECT_THAT(finding->text, ::testing::HasSubstr("times the 0.1 px of pose.point_std_px"));
  EXPECT_EQ(finding->shots, std::vector<std::size_t>{0});
}

}  // namespace
}  // namespace scattermeter::apps
