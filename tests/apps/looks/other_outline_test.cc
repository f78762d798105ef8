#include "apps/looks/other_outline.h"

#include <optional>
#include <variant>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "apps/simulation/bodies_rig.h"
#include "apps/simulation/virtual_shots.h"
#include "calib/pose/shot_pose.h"
#include "tests/fixtures/apps/body_rig.h"

namespace scattermeter::apps {
namespace {

TEST(OtherOutline, OfThePieceThatIsInTheShot) {
  Rig rig = bodies_rig(480, 1.4, {{"m", plastic()}}, {"cube", "pyramid"});
  const ObjectScenes scenes = bodies_scenes(rig);
  const VirtualShots shots(rig, scenes, {.noise = true});
  const capture::ShotSource source = shots.source(1);
  const auto& frames = std::get<capture::FrameSource>(source.open);
  const PoseResult pose = calib::pose_from_points(rig.scene, rig.pose);
  Contours contours;
  for (const auto& [name, object] : scenes) {
    contours[name] =
        calib::contour_points(*object.rays, rig.scene.camera.intrinsics, pose.camera_from_world,
                              calib::outline_cell_px(rig.scene.camera.intrinsics.width_px));
  }
  const auto told = [&](std::size_t shot_idx) {
    const calib::OutlineLook look =
        calib::look_at_outline(contours.at(rig.scene.shots[shot_idx].object), frames(shot_idx, 0),
                               rig.scene.camera.sensor.noise);
    return other_outline(rig, scenes, pose, contours, shot_idx, look, frames);
  };
  EXPECT_FALSE(told(0).has_value());
  rig.scene.shots[0].object = "pyramid";
  const std::optional<Finding> finding = told(0);
  ASSERT_TRUE(finding.has_value());
  EXPECT_THAT(finding->text, ::testing::HasSubstr("has the outline of cube"));
  EXPECT_THAT(finding->text, ::testing::HasSubstr("not of pyramid"));
  EXPECT_EQ(finding->shots, std::vector<std::size_t>{0});
}

}  // namespace
}  // namespace scattermeter::apps
