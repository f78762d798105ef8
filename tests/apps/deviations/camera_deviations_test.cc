#include <cmath>

#include <gtest/gtest.h>

#include "apps/deviations/deviation_runs.h"
#include "apps/simulation/shot_renderer.h"

namespace scattermeter::apps {
namespace {

// The image of the object's place, and of one above it, px.
std::vector<Eigen::Vector2d> images(const Rig& rig) {
  const CameraView view = true_view(rig);
  return project(view.intrinsics, view.camera_from_world, {{0, 0, 9}, {0, 0, 19}});
}

struct Seen {
  std::vector<Eigen::Vector2d> before, after;
};
Seen seen(const char* kind, const DeviationDraw& draw) {
  const DeviationRun run{.kind = &deviation_named(kind), .body = "cube"};
  TrueSetup truth = true_setup(stated_rig(run, 3872), stated_mesh("cube"));
  Seen out;
  out.before = images(truth.rig);
  run.kind->truth(truth, draw);
  out.after = images(truth.rig);
  return out;
}

TEST(CameraDeviations, Poses) {
  // At 174 mm and 9836 px focal length, a millimetre is 57 px.
  const Seen knocked = seen("camera knocked", {1, 1, 1});
  EXPECT_NEAR(knocked.after[0].x() - knocked.before[0].x(), -56.7, 1.0);
  const Seen rolled = seen("camera rolled", {5, 1, 1});
  const Eigen::Vector2d was = rolled.before[1] - rolled.before[0];
  const Eigen::Vector2d is = rolled.after[1] - rolled.after[0];
  EXPECT_NEAR(std::abs(std::atan2(is.x() * was.y() - is.y() * was.x(), is.dot(was))),
              5.0 * 3.14159265 / 180.0, 1e-3);
  const Seen back = seen("camera farther away", {10, 1, 1});
  EXPECT_LT((back.after[1] - back.after[0]).norm(), (back.before[1] - back.before[0]).norm());
  const Seen moved = seen("camera displaced", {1, 1, 1});
  EXPECT_NEAR(moved.after[0].x() - moved.before[0].x(), -0.6 * 56.7, 1.0);
}

TEST(CameraDeviations, Lenses) {
  const Seen longer = seen("focal length off", {5, 1, 1});
  EXPECT_NEAR(
      (longer.after[1] - longer.after[0]).norm() / (longer.before[1] - longer.before[0]).norm(),
      1.05, 1e-3);
  const Seen shifted = seen("principal point off", {1, 1, 1});
  EXPECT_NEAR(shifted.after[0].x() - shifted.before[0].x(), 38.72, 0.01);
  const DeviationRun run{.kind = &deviation_named("focal length off"), .body = "cube"};
  TrueSetup truth = true_setup(stated_rig(run, 320), stated_mesh("cube"));
  run.kind->truth(truth, {5, 1, 1});
  EXPECT_TRUE(truth.marks_by_true_camera);
}

TEST(CameraDeviations, Marks) {
  const DeviationRun run{.kind = &deviation_named("marks shifted"), .body = "cube"};
  Rig stated = stated_rig(run, 320);
  const Rig before = stated;
  run.kind->stated(stated, {2, -1, 4});
  for (std::size_t i = 0; i < stated.pose.points.size(); ++i) {
    const Eigen::Vector2d d = stated.pose.points[i].image_px - before.pose.points[i].image_px;
    EXPECT_NEAR((d - Eigen::Vector2d(-2, 0)).norm(), 0.0, 1e-12);
  }
}

TEST(CameraDeviations, MovedAndMirrored) {
  std::vector<ColourFrame> frames(2, black_frame(9, 5, 4000.0));
  for (ColourFrame& frame : frames) frame.at(0, 3, 2) = 100.0F;
  deviation_named("object moved between the shots").frames(frames, {1.25, 1, 1});
  EXPECT_EQ(frames[0].at(0, 3, 2), 100.0F);
  EXPECT_EQ(frames[1].at(0, 3, 2), 0.0F);
  EXPECT_NEAR(frames[1].at(0, 4, 2), 75.0, 1e-4);
  EXPECT_NEAR(frames[1].at(0, 5, 2), 25.0, 1e-4);
  deviation_named("picture mirrored").frames(frames, {1, 1, 1});
  EXPECT_EQ(frames[0].at(0, 5, 2), 100.0F);
}

}  // namespace
}  // namespace scattermeter::apps
