#include "apps/instrument/displaced_round_bodies.h"

#include <string>
#include <variant>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "apps/instrument/open_objects.h"
#include "apps/instrument/seen_shots.h"
#include "apps/simulation/virtual_shots.h"
#include "calib/pose/shot_pose.h"
#include "core/mesh/bodies.h"
#include "tests/fixtures/apps/body_rig.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

// What shots of a body that stands so far from its stated position say, where their light is
// doubtful in the given shots.
std::vector<Finding> found(const std::string& body, const Eigen::Vector3d& off_mm,
                           const std::vector<Finding>& of_light) {
  const Rig rig = body_rig(body, 2);
  const ObjectScenes moved = open_objects(rig, [&](const SceneObject& object) {
    TriangleMesh mesh = body_mesh(object.name);
    for (Eigen::Vector3d& v : mesh.vertices_mm) v += off_mm;
    return mesh;
  });
  const VirtualShots shots(rig, moved, {});
  const capture::ShotSource source = shots.source(5);
  const ObjectScenes objects = bodies_scenes(rig);
  LitObjects lit(rig.scene, objects, 2.0, 0.0);
  KeptLight kept;
  const SharedView view =
      see_all(rig.scene, objects, lit, calib::pose_from_points(rig.scene, rig.pose));
  SeenShots seen(rig, objects, lit, source, view, false, {}, kept, nullptr);
  seen.open();
  OutlineFindings outlines;
  outlines.unjudged = {body};
  find_displaced_round_bodies(rig, objects, seen.shots(), of_light,
                              std::get<capture::FrameSource>(source.open), outlines);
  return outlines.findings;
}

TEST(DisplacedRoundBodies, AreTold) {
  const std::vector<Finding> of_light = {{"object covered", "", "", {1}},
                                         {"image not explained", "", "", {0}}};
  const std::vector<Finding> told = found("sphere", {3.0, 0.0, 0.0}, of_light);
  ASSERT_THAT(told, SizeIs(1));
  EXPECT_EQ(told[0].cause, "mesh displaced");
  EXPECT_THAT(told[0].text, HasSubstr("mesh of sphere displaced"));
  EXPECT_THAT(told[0].text, HasSubstr("across the line of sight (x +"));
  EXPECT_THAT(told[0].shots, ::testing::ElementsAre(0, 1));
}

TEST(DisplacedRoundBodies, AreLookedForInDoubtfulShotsOnly) {
  EXPECT_THAT(found("sphere", {3.0, 0.0, 0.0}, {}), IsEmpty());
  const std::vector<Finding> of_light = {{"object covered", "", "", {0, 1}}};
  EXPECT_THAT(found("sphere", {0.0, 0.0, 0.0}, of_light), IsEmpty());
}

}  // namespace
}  // namespace scattermeter::apps
