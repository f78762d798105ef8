#include "apps/looks/other_size.h"

#include <cstdio>
#include <variant>

#include <gtest/gtest.h>

#include "apps/simulation/bodies_rig.h"
#include "apps/simulation/virtual_shots.h"
#include "calib/pose/shot_pose.h"
#include "core/mesh/bodies.h"
#include "tests/fixtures/apps/body_rig.h"

namespace scattermeter::apps {
namespace {

TEST(OtherSize, IsFoundFromTheOutline) {
  const Rig rig = bodies_rig(480, 1.4, {{"m", plastic()}}, {"pyramid"});
  const ObjectScenes scenes = bodies_scenes(rig);
  const VirtualShots shots(rig, scenes, {.noise = true});
  const capture::ShotSource source = shots.source(1);
  const capture::RawFrame frame = std::get<capture::FrameSource>(source.open)(0, 0);
  const PoseResult pose = calib::pose_from_points(rig.scene, rig.pose);
  const auto told = [&](double times_true) {
    const ObjectScenes stated = open_objects(rig, [&](const SceneObject& object) {
      TriangleMesh mesh = body_mesh(object.name);
      for (Eigen::Vector3d& v : mesh.vertices_mm) v *= times_true;
      return mesh;
    });
    return other_size(stated.at("pyramid"), rig.scene.camera.intrinsics, pose, frame,
                      rig.scene.camera.sensor.noise);
  };
  EXPECT_FALSE(told(1.0).has_value());
  const auto finding = told(0.75);
  ASSERT_TRUE(finding.has_value());
  EXPECT_EQ(finding->cause, "mesh scaled");
  double size = 0.0;
  ASSERT_EQ(std::sscanf(finding->text.c_str(),
                        "mesh scaled: pyramid has the outline of a body about %lf times", &size),
            1)
      << finding->text;
  EXPECT_NEAR(size * 0.75, 1.0, 0.12);
  EXPECT_FALSE(told(0.3).has_value());  // out of reach
}

}  // namespace
}  // namespace scattermeter::apps
