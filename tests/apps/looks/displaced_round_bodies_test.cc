#include "apps/looks/displaced_round_bodies.h"

#include <set>
#include <string>
#include <variant>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "apps/instrument/seen_shots.h"
#include "apps/rig/open_objects.h"
#include "apps/simulation/virtual_shots.h"
#include "calib/pose/shot_pose.h"
#include "core/mesh/bodies.h"
#include "tests/fixtures/apps/body_rig.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

// Two shots of a body that stands so far from its stated position.
class DisplacedBody {
 public:
  DisplacedBody(const std::string& body, const Eigen::Vector3d& off_mm)
      : rig_(body_rig(body, 2)),
        moved_(open_objects(rig_,
                            [&](const SceneObject& object) {
                              TriangleMesh mesh = body_mesh(object.name);
                              for (Eigen::Vector3d& v : mesh.vertices_mm) v += off_mm;
                              return mesh;
                            })),
        shots_(rig_, moved_, {}),
        source_(shots_.source(5)),
        objects_(bodies_scenes(rig_)),
        lit_(rig_.scene, objects_, 2.0, 0.0),
        view_(see_all(rig_.scene, objects_, lit_, calib::pose_from_points(rig_.scene, rig_.pose))),
        seen_(rig_, objects_, lit_, source_, view_, false, {}, kept_, nullptr) {
    seen_.open();
  }

  // What they say where their light is doubtful in the given shots.
  std::vector<Finding> found(const std::set<std::size_t>& doubtful) {
    OutlineFindings outlines;
    for (const auto& [name, object] : objects_) outlines.unjudged.insert(name);
    find_displaced_round_bodies(rig_, objects_, seen_.shots(), doubtful, frames(), outlines);
    return outlines.findings;
  }
  void tell(std::vector<ChannelResult>& results) {
    tell_of_displaced_round_bodies(rig_, objects_, seen_.shots(), frames(), results);
  }
  std::string file(std::size_t shot_idx) const { return rig_.scene.shots.at(shot_idx).file; }

 private:
  const capture::FrameSource& frames() const {
    return std::get<capture::FrameSource>(source_.open);
  }

  Rig rig_;
  ObjectScenes moved_;
  VirtualShots shots_;
  capture::ShotSource source_;
  ObjectScenes objects_;
  LitObjects lit_;
  KeptLight kept_;
  SharedView view_;
  SeenShots seen_;
};

std::vector<Finding> found(const std::string& body, const Eigen::Vector3d& off_mm,
                           const std::set<std::size_t>& doubtful) {
  return DisplacedBody(body, off_mm).found(doubtful);
}

// A displacement is the first reason of what a fit has refused of these shots, and of nothing else.
TEST(DisplacedRoundBodies, AreTheFirstReasonOfWhatAFitRefused) {
  DisplacedBody sphere("sphere", {1.5, 0.0, 0.0});
  std::vector<ChannelResult> results(3);
  for (ChannelResult& r : results) {
    r.shots = {sphere.file(0), sphere.file(1)};
    r.estimate.rows = 100;
    r.estimate.reasons = {"misfit"};
  }
  results[1].estimate.reasons.clear();  // not refused
  results[2].estimate.rows = 0;         // dark: there was no fit
  sphere.tell(results);
  ASSERT_THAT(results[0].estimate.reasons, SizeIs(2));
  EXPECT_THAT(results[0].estimate.reasons[0], HasSubstr("mesh of sphere displaced"));
  EXPECT_THAT(results[1].estimate.reasons, IsEmpty());
  EXPECT_THAT(results[2].estimate.reasons, SizeIs(1));
  std::vector<ChannelResult> of_cube(1, results[2]);
  of_cube[0].estimate.rows = 100;
  DisplacedBody("cube", {1.5, 0.0, 0.0}).tell(of_cube);
  EXPECT_THAT(of_cube[0].estimate.reasons, SizeIs(1));
}

TEST(DisplacedRoundBodies, AreTold) {
  const std::vector<Finding> told = found("sphere", {3.0, 0.0, 0.0}, {0, 1});
  ASSERT_THAT(told, SizeIs(1));
  EXPECT_EQ(told[0].cause, "mesh displaced");
  EXPECT_THAT(told[0].text, HasSubstr("mesh of sphere displaced"));
  EXPECT_THAT(told[0].text, HasSubstr("across the line of sight (x +"));
  EXPECT_THAT(told[0].shots, ::testing::ElementsAre(0, 1));
}

TEST(DisplacedRoundBodies, AreLookedForInDoubtfulShotsOnly) {
  EXPECT_THAT(found("sphere", {3.0, 0.0, 0.0}, {}), IsEmpty());
  EXPECT_THAT(found("sphere", {0.0, 0.0, 0.0}, {0, 1}), IsEmpty());
}

}  // namespace
}  // namespace scattermeter::apps
