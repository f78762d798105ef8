#include "apps/looks/outline_watch.h"

#include <cmath>
#include <cstdio>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "apps/simulation/bodies_rig.h"
#include "apps/simulation/virtual_shots.h"
#include "calib/pose/shot_pose.h"
#include "core/camera/camera_model.h"
#include "core/mesh/bodies.h"
#include "tests/fixtures/apps/body_rig.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

// Cube and pyramid under two LEDs, 480 px wide; the object in the shots may be displaced.
class OutlineWatchTest : public ::testing::Test {
 protected:
  explicit OutlineWatchTest(const std::vector<std::string>& bodies = {"cube", "pyramid"},
                            const std::vector<NamedMedia>& materials = {{"m", plastic()}})
      : rig_(bodies_rig(480, 1.4, materials, bodies)), scenes_(bodies_scenes(rig_)) {
    rig_.pose.options.point_std_px = 0.2;
  }
  capture::ShotSource shots(const Eigen::Vector3d& cube_moved_mm) {
    moved_ = open_objects(rig_, [&](const SceneObject& object) {
      TriangleMesh mesh = body_mesh(object.name);
      for (Eigen::Vector3d& v : mesh.vertices_mm) {
        if (object.name == "cube") v += cube_moved_mm;
      }
      return mesh;
    });
    virtual_ = std::make_unique<VirtualShots>(rig_, moved_, VirtualShotOptions{.noise = true});
    return virtual_->source(1);
  }
  OutlineFindings findings(const capture::ShotSource& source) {
    const PoseResult pose = calib::pose_from_points(rig_.scene, rig_.pose);
    OutlineWatch watch(rig_, scenes_, pose);
    const capture::ShotSource watched = capture::shown_to(
        [&](std::size_t shot_idx, const capture::RawFrame& frame) { watch.look(shot_idx, frame); },
        source);
    for (const std::size_t i : source.shot_idxs) {
      std::get<capture::FrameSource>(watched.open)(i, 0);
    }
    return watch.findings(source);
  }

  Rig rig_;
  ObjectScenes scenes_, moved_;
  std::unique_ptr<VirtualShots> virtual_;
};

TEST_F(OutlineWatchTest, GoodRig) {
  const OutlineFindings found = findings(shots({0, 0, 0}));
  for (const Finding& f : found.findings) ADD_FAILURE() << f.text;
  EXPECT_TRUE(found.notes.empty());
  EXPECT_TRUE(found.shifts.empty());
  EXPECT_TRUE(found.sizes_open.empty());
  ASSERT_TRUE(found.diagnosis);
  EXPECT_EQ(found.looked_at.size(), 4U);
}

TEST_F(OutlineWatchTest, MeshDisplaced) {
  for (const Eigen::Vector3d& moved : {Eigen::Vector3d(1.0, 0.0, 0.0),
                                       Eigen::Vector3d(0.0, 2.4, 1.8), Eigen::Vector3d(-4, 3, 0)}) {
    const OutlineFindings found = findings(shots(moved));
    ASSERT_EQ(found.findings.size(), 1U) << moved.transpose();
    const Finding& f = found.findings.front();
    EXPECT_EQ(f.cause, "mesh displaced") << f.text;
    double x_mm = 0.0, y_mm = 0.0, z_mm = 0.0;
    ASSERT_EQ(
        std::sscanf(f.text.c_str(), "mesh displaced: by its outline, cube stands [%lf, %lf, %lf]",
                    &x_mm, &y_mm, &z_mm),
        3)
        << f.text;
    EXPECT_LT((Eigen::Vector3d(x_mm, y_mm, z_mm) - moved).norm(), 0.1) << f.text;
    EXPECT_EQ(f.shots, (std::vector<std::size_t>{0, 1}));
    ASSERT_TRUE(found.diagnosis);
    const Eigen::VectorXd& value = found.diagnosis->explanations.at(1).value;
    // Of the quick look. Along the line of sight it is known from the size alone.
    const Eigen::Vector3d sight = Eigen::Vector3d(0, 100, -140).normalized();
    const Eigen::Vector3d off = value - moved;
    EXPECT_LT((off - sight * sight.dot(off)).norm(), 0.1 * moved.norm()) << f.text;
  }
}

// By too little for the quick look, and by more than the rig states.
TEST_F(OutlineWatchTest, MeshALittleDisplaced) {
  const auto at_mm = [](const Finding& f) {
    Eigen::Vector3d out(NAN, NAN, NAN);
    std::sscanf(f.text.c_str(), "mesh displaced: by its outline, cube stands [%lf, %lf, %lf]",
                &out.x(), &out.y(), &out.z());
    return out;
  };
  const Eigen::Vector3d far(0.0, 0.6, 0.0), near(0.0, 0.2, 0.0);
  const OutlineFindings found = findings(shots(far));
  ASSERT_EQ(found.findings.size(), 1U);
  EXPECT_LT((at_mm(found.findings[0]) - far).norm(), 0.05) << found.findings[0].text;
  EXPECT_EQ(found.findings[0].shots, (std::vector<std::size_t>{0, 1}));
  EXPECT_FALSE(found.diagnosis->agrees);
  EXPECT_TRUE(found.notes.empty());
  EXPECT_TRUE(found.shifts.empty());
  for (const Finding& f : findings(shots(near)).findings) ADD_FAILURE() << f.text;
}

TEST_F(OutlineWatchTest, AnotherSize) {
  const capture::ShotSource source = shots({0, 0, 0});
  scenes_ = open_objects(rig_, [](const SceneObject& object) {
    TriangleMesh mesh = body_mesh(object.name);
    for (Eigen::Vector3d& v : mesh.vertices_mm) v *= object.name == "cube" ? 1.3 : 1.0;
    return mesh;
  });
  const OutlineFindings found = findings(source);
  ASSERT_EQ(found.findings.size(), 1U);
  EXPECT_THAT(found.findings[0].text, HasSubstr("smaller than its mesh"));
  EXPECT_EQ(found.findings[0].shots, (std::vector<std::size_t>{0, 1}));
}

// A mesh a little larger than the piece: its edges may be cut back as well.
TEST_F(OutlineWatchTest, ALittleSmallerThanItsMesh) {
  const capture::ShotSource source = shots({0, 0, 0});
  rig_.scene.objects[0].edge_std_mm = 0.2;
  scenes_ = open_objects(rig_, [](const SceneObject& object) {
    TriangleMesh mesh = body_mesh(object.name);
    for (Eigen::Vector3d& v : mesh.vertices_mm) v *= object.name == "cube" ? 1.015 : 1.0;
    return mesh;
  });
  const OutlineFindings found = findings(source);
  EXPECT_TRUE(found.findings.empty());
  ASSERT_EQ(found.sizes_open.size(), 1U);
  // From a third of the true difference to all of it.
  EXPECT_GT(found.sizes_open.at("cube"), 0.005);
  EXPECT_LT(found.sizes_open.at("cube"), 0.015);
  ASSERT_EQ(found.notes.size(), 1U);
  EXPECT_THAT(found.notes[0], HasSubstr("outline of cube lies"));
}

TEST_F(OutlineWatchTest, FileOfAnotherObject) {
  capture::ShotSource source = shots({0, 0, 0});
  const auto frames = std::get<capture::FrameSource>(source.open);
  source.open = capture::FrameSource([frames](std::size_t i, std::size_t k) {
    return frames(i == 0 ? 2 : i == 2 ? 0 : i, k);
  });
  const OutlineFindings found = findings(source);
  ASSERT_EQ(found.findings.size(), 2U);
  for (const Finding& f : found.findings) EXPECT_EQ(f.cause, "file exchanged") << f.text;
  EXPECT_THAT(found.findings[0].text, HasSubstr("outline of pyramid"));
}

// The marks were read 2 px low and are stated to that: the outline shows it.
TEST_F(OutlineWatchTest, PoseWithinItsUncertainty) {
  const capture::ShotSource source = shots({0, 0, 0});
  for (PointPair& p : rig_.pose.points) p.image_px.y() += 2.0;
  rig_.pose.options.point_std_px = 2.0;
  rig_.pose.options.inlier_px = 8.0;
  const OutlineFindings found = findings(source);
  EXPECT_TRUE(found.findings.empty());
  ASSERT_EQ(found.notes.size(), 1U);
  ASSERT_EQ(found.shifts.size(), 2U);
  const PoseResult stated = calib::pose_from_points(rig_.scene, rig_.pose);
  for (const auto& [name, shift] : found.shifts) {
    const Eigen::Vector3d center = scenes_.at(name).box.center_mm();
    const auto image = [&](const Rigid3d& pose) {
      return project(rig_.scene.camera.intrinsics, pose, {center}).front();
    };
    const Eigen::Vector2d by =
        image(shifted_pose(stated.camera_from_world, shift)) - image(stated.camera_from_world);
    // Most of it; the fit of the shots gives the rest.
    EXPECT_NEAR(by.x(), 0.0, 0.5) << name;
    EXPECT_LT(by.y(), -1.0) << name;
    EXPECT_GT(by.y(), -2.5) << name;
  }
  EXPECT_THAT(found.notes[0], HasSubstr("px high"));
}

TEST_F(OutlineWatchTest, NothingSeen) {
  capture::ShotSource source = shots({0, 0, 0});
  const auto frames = std::get<capture::FrameSource>(source.open);
  source.open = capture::FrameSource([frames](std::size_t i, std::size_t k) {
    capture::RawFrame frame = frames(i, k);
    std::fill(frame.samples.begin(), frame.samples.end(), std::uint16_t{70});
    return frame;
  });
  const OutlineFindings found = findings(source);
  EXPECT_TRUE(found.findings.empty());
  EXPECT_FALSE(found.diagnosis);
  EXPECT_EQ(found.notes.size(), 4U);
}

// Bodies without straight edges.
class RoundBodyWatchTest : public OutlineWatchTest {
 protected:
  RoundBodyWatchTest() : OutlineWatchTest({"sphere", "scan"}) {}
};

// Pieces of three materials in one jig: six shots.
class ManyPiecesWatchTest : public OutlineWatchTest {
 protected:
  ManyPiecesWatchTest()
      : OutlineWatchTest({"cube"}, {{"a", plastic()}, {"b", plastic()}, {"c", plastic()}}) {}
};

// All shots of the displaced mesh are refused, not only those that were looked at again.
TEST_F(ManyPiecesWatchTest, AllShotsOfADisplacedMesh) {
  const OutlineFindings found = findings(shots({1.0, 0.0, 0.0}));
  ASSERT_EQ(found.findings.size(), 1U);
  EXPECT_EQ(found.findings[0].shots, (std::vector<std::size_t>{0, 1, 2, 3, 4, 5}));
}

// Their limb is as dark as the lamp leaves it, so they are not judged by their outline.
TEST_F(RoundBodyWatchTest, AreNotJudged) {
  const OutlineFindings found = findings(shots({0, 0, 0}));
  EXPECT_TRUE(found.findings.empty());
  EXPECT_FALSE(found.diagnosis);
}

}  // namespace
}  // namespace scattermeter::apps
