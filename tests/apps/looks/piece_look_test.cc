#include "apps/looks/piece_look.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "apps/rig/open_objects.h"
#include "apps/simulation/virtual_shots.h"
#include "calib/pose/shot_pose.h"
#include "core/mesh/bodies.h"
#include "core/scene/default_uncertainty.h"
#include "tests/fixtures/apps/body_rig.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

// What the outline of a cube says that stands off its mesh by this and is larger by this factor.
PieceLook look_at_cube(const Eigen::Vector3d& off_mm, double position_std_mm, double factor = 1.0,
                       double edge_std_mm = 0.1) {
  Rig rig = body_rig("cube", 2);
  TriangleMesh mesh = body_mesh("cube");
  const Eigen::Vector3d center_mm = bounds(mesh).center_mm();
  for (Eigen::Vector3d& v : mesh.vertices_mm) v = center_mm + factor * (v - center_mm) + off_mm;
  const ObjectScenes moved = open_objects(rig, [&](const SceneObject&) { return mesh; });
  const VirtualShots shots(rig, moved, {.noise = true});
  default_uncertainty::take_where_none(rig.scene);
  rig.scene.objects.front().position_std_mm = position_std_mm;
  rig.scene.objects.front().edge_std_mm = edge_std_mm;
  const ObjectScenes stated = bodies_scenes(rig);
  const capture::ShotSource source = shots.source(3);
  return look_at_piece(rig, stated, "cube", calib::pose_from_points(rig.scene, rig.pose), {0, 1},
                       std::get<capture::FrameSource>(source.open));
}

TEST(PieceLook, TellsWhereAPieceStandsThatIsHardlyKnown) {
  const Eigen::Vector3d off_mm(0.8, -0.6, 0.5);
  const PieceLook look = look_at_cube(off_mm, 0.6);
  EXPECT_FALSE(look.finding);
  ASSERT_TRUE(look.moved);
  EXPECT_LT(
      (look.moved->by * Eigen::Vector3d(0, 0, 10) - Eigen::Vector3d(0, 0, 10) - off_mm).norm(),
      4.0 * look.moved->position_std_mm);
  EXPECT_LT(look.moved->position_std_mm, 0.4);
}

TEST(PieceLook, TellsAPieceThatStandsFartherOffThanStated) {
  const PieceLook look = look_at_cube({0.8, -0.6, 0.5}, 0.1);
  EXPECT_FALSE(look.moved);
  ASSERT_TRUE(look.finding);
  EXPECT_EQ(look.finding->cause, "mesh displaced");
  EXPECT_THAT(look.finding->text, HasSubstr("cube stands [0.8"));
  EXPECT_EQ(look.finding->shots, (std::vector<std::size_t>{0, 1}));
}

TEST(PieceLook, LeavesAPieceWhereItStandsAsStated) {
  const PieceLook look = look_at_cube(Eigen::Vector3d::Zero(), 0.1);
  EXPECT_FALSE(look.finding);
  EXPECT_FALSE(look.moved);
}

// A smaller outline may be that of cut edges, a larger one may not.
TEST(PieceLook, CutEdgesMakeNoPieceStandFartherAway) {
  EXPECT_FALSE(look_at_cube(Eigen::Vector3d::Zero(), 0.1, 0.985).finding);
  EXPECT_TRUE(look_at_cube(Eigen::Vector3d::Zero(), 0.1, 0.985, 0.0).finding);
  EXPECT_TRUE(look_at_cube(Eigen::Vector3d::Zero(), 0.1, 1.015).finding);
}

TEST(PieceLook, ShotsUnderOtherLightsTellFirst) {
  std::vector<SceneShot> shots(6);
  for (SceneShot& shot : shots) {
    shot.object = "cube";
    shot.lights = {"led1"};
  }
  shots[1].object = "pyramid";
  shots[4].lights = {"led2"};
  EXPECT_EQ(telling_shots(shots, "cube"), (std::vector<std::size_t>{0, 4, 2, 3}));
  EXPECT_EQ(telling_shots(shots, "pyramid"), (std::vector<std::size_t>{1}));
  EXPECT_TRUE(telling_shots(shots, "bust").empty());
}

}  // namespace
}  // namespace scattermeter::apps
