#include "apps/looks/moved_piece.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "apps/simulation/bodies_rig.h"
#include "core/scene/surroundings.h"
#include "tests/fixtures/apps/body_rig.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

struct MovedCube : public ::testing::Test {
  Rig rig = body_rig("cube", 2);
  ObjectScenes objects = bodies_scenes(rig);
  const ObjectScene& cube = objects.at("cube");
  PiecePlace place = [] {
    PiecePlace out;
    out.off << 0.4, -0.3, 0.2, 0.02, 0.0, -0.01;
    out.covariance.diagonal() << 4e-4, 1e-4, 9e-4, 1e-6, 1e-6, 1e-6;
    return out;
  }();
};

TEST_F(MovedCube, StandsWhereItsPlaceSays) {
  const MovedPiece moved = moved_piece(rig.scene, cube, place);
  const Eigen::Vector3d center = cube.box.center_mm();
  EXPECT_LT((moved.by * center - center - place.off.head<3>()).norm(), 1e-12);
  const Eigen::AngleAxisd turn(moved.by.rotation);
  EXPECT_LT((turn.angle() * turn.axis() - place.off.tail<3>()).norm(), 1e-12);
  EXPECT_NEAR(moved.position_std_mm, 0.03, 1e-12);
  EXPECT_THAT(moved.note, HasSubstr("cube was found by its outline [0.40, -0.30, 0.20] mm from"));
  EXPECT_THAT(moved.note, HasSubstr("turned by 1.28 degrees; its position is known to 0.03 mm"));
  place.covariance(4, 4) = 1e-4;  // 0.01 rad, at a distance of its size
  EXPECT_NEAR(moved_piece(rig.scene, cube, place).position_std_mm, 0.01 * cube.size_mm(), 1e-12);
}

TEST_F(MovedCube, DoesNotGoBelowAPlane) {
  const double lowest_mm = cube.box.min_mm.z();
  place.off << 0.0, 0.0, -0.5, 0.0, 0.0, 0.0;
  EXPECT_NEAR(moved_piece(rig.scene, cube, place).by.translation_mm.z(), -0.5, 1e-12);
  rig.scene.surroundings.plane = plane_below(rig.scene, cube);
  EXPECT_NEAR(moved_piece(rig.scene, cube, place).by.translation_mm.z(), 0.0, 1e-12);
  rig.scene.surroundings.plane->z_mm = lowest_mm - 0.2;
  EXPECT_NEAR(moved_piece(rig.scene, cube, place).by.translation_mm.z(), -0.2, 1e-12);
}

TEST_F(MovedCube, StaysInContactAndWhereItWasFound) {
  SceneObject& stated = rig.scene.objects.front();
  EXPECT_TRUE(may_move(rig.scene, stated));
  rig.scene.surroundings.plane = plane_below(rig.scene, cube);
  EXPECT_TRUE(may_move(rig.scene, stated));
  rig.scene.surroundings.plane->contact = PlaneContact::kBlack;
  EXPECT_FALSE(may_move(rig.scene, stated));
  rig.scene.surroundings.plane.reset();
  stated.to_be_found = PieceSearch{};
  EXPECT_FALSE(may_move(rig.scene, stated));
}

TEST_F(MovedCube, ItsRigHasItThere) {
  const MovedPieces pieces = {{"cube", moved_piece(rig.scene, cube, place)}};
  const auto moved = moved_rig(rig, objects, pieces);
  const ObjectScene& there = moved->objects.at("cube");
  EXPECT_EQ(there.stated, &moved->rig.scene.object("cube"));
  EXPECT_EQ(there.stated->position_std_mm, pieces.at("cube").position_std_mm);
  ASSERT_EQ(there.mesh().vertices_mm.size(), cube.mesh().vertices_mm.size());
  for (std::size_t i = 0; i < there.mesh().vertices_mm.size(); ++i) {
    EXPECT_LT(
        (there.mesh().vertices_mm[i] - pieces.at("cube").by * cube.mesh().vertices_mm[i]).norm(),
        1e-9);
  }
  // From there again, as its mesh is that of the first position.
  const auto again = moved_rig(moved->rig, moved->objects, pieces);
  EXPECT_LT((again->objects.at("cube").mesh().vertices_mm[0] -
             pieces.at("cube").by * there.mesh().vertices_mm[0])
                .norm(),
            1e-9);
}

}  // namespace
}  // namespace scattermeter::apps
