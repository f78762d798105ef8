#include "apps/looks/scaled_piece.h"

#include <cstdio>
#include <memory>
#include <optional>
#include <variant>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "apps/simulation/bodies_rig.h"
#include "apps/simulation/virtual_shots.h"
#include "calib/pose/shot_pose.h"
#include "core/mesh/bodies.h"
#include "tests/fixtures/apps/body_rig.h"

namespace scattermeter::apps {
namespace {

// A cube under two LEDs, whose mesh in the rig is smaller or larger about its base, and displaced.
class ScaledPieceTest : public ::testing::Test {
 protected:
  ScaledPieceTest() : rig_(bodies_rig(968, 1.4, {{"m", plastic()}}, {"cube"})) {
    rig_.pose.options.point_std_px = 0.2;
    pose_ = calib::pose_from_points(rig_.scene, rig_.pose);
    piece_ = open_objects(rig_, [](const SceneObject& object) { return body_mesh(object.name); });
    virtual_ = std::make_unique<VirtualShots>(rig_, piece_, VirtualShotOptions{.noise = true});
    source_ = virtual_->source(1);
  }
  std::optional<Finding> told(double mesh_of_true, const Eigen::Vector3d& displaced_mm) {
    const ObjectScenes stated = open_objects(rig_, [&](const SceneObject& object) {
      TriangleMesh mesh = body_mesh(object.name);
      for (Eigen::Vector3d& v : mesh.vertices_mm) v = mesh_of_true * v + displaced_mm;
      return mesh;
    });
    return scaled_piece(rig_, stated, rig_.scene.objects[0], 0.1, pose_,
                        std::get<capture::FrameSource>(source_.open), source_.shot_idxs);
  }

  Rig rig_;
  ObjectScenes piece_;
  PoseResult pose_;
  std::unique_ptr<VirtualShots> virtual_;
  capture::ShotSource source_;
};

TEST_F(ScaledPieceTest, SizeIsToldWhereverThePieceStandsNearItsPlace) {
  for (const Eigen::Vector3d& displaced_mm :
       {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(0.1, -0.1, 0.0)}) {
    for (const double mesh : {0.98, 1.02}) {
      const std::optional<Finding> finding = told(mesh, displaced_mm);
      ASSERT_TRUE(finding.has_value()) << mesh;
      EXPECT_EQ(finding->cause, "mesh scaled");
      EXPECT_EQ(finding->shots, source_.shot_idxs);
      double percent = 0.0;
      ASSERT_EQ(
          std::sscanf(finding->text.c_str(), "mesh of cube scaled: the object is %lf ±", &percent),
          1)
          << finding->text;
      EXPECT_NEAR(percent, 2.0, 0.4) << finding->text;
      EXPECT_THAT(finding->text,
                  ::testing::HasSubstr(mesh < 1.0 ? "larger than its mesh" : "smaller than"));
    }
    EXPECT_FALSE(told(1.0, displaced_mm).has_value());
  }
}

TEST_F(ScaledPieceTest, AStatedDeviationIsAllowed) {
  rig_.scene.objects[0].scale_relative_std = 0.02;
  EXPECT_FALSE(told(0.98, {0, 0, 0}).has_value());
}

TEST(SizeLook, EdgesCutBackMakeAPieceSmallerOnly) {
  EXPECT_TRUE(seems_scaled({4.0, 8.0, 4.0, 1000.0}));
  EXPECT_FALSE(seems_scaled({1.3, 8.0, 0.0, 1000.0}));
  EXPECT_FALSE(seems_scaled({-8.0, 8.0, 4.0, 1000.0}));
  EXPECT_TRUE(seems_scaled({-15.0, 8.0, 4.0, 1000.0}));
  EXPECT_TRUE(seems_scaled({-4.0, 8.0, 0.0, 1000.0}));
}

// 8 px on either side of 1000 px are 1.6 % of the size.
TEST(SizeLook, LeavesHalfOfItsExplanationBySizeOpen) {
  EXPECT_NEAR(size_left_open({-8.0, 8.0, 4.0, 1000.0}), 0.008, 1e-12);
  EXPECT_EQ(size_left_open({-2.0, 8.0, 4.0, 1000.0}), 0.0);
  EXPECT_EQ(size_left_open({8.0, 8.0, 4.0, 1000.0}), 0.0);
  EXPECT_EQ(size_left_open({-8.0, 8.0, 0.0, 1000.0}), 0.0);
  EXPECT_THAT(size_note("cube", {-8.0, 8.0, 4.0, 1000.0}), ::testing::HasSubstr("known to 0.8 %"));
}

}  // namespace
}  // namespace scattermeter::apps
