#include "apps/instrument/focus.h"

#include <cmath>
#include <memory>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "apps/simulation/bodies_rig.h"
#include "apps/simulation/virtual_shots.h"
#include "calib/pose/shot_pose.h"
#include "tests/fixtures/apps/body_rig.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

// Gaussian blur of each phase of the filter array by itself.
capture::RawFrame blurred(const capture::RawFrame& frame, double std_px) {
  const int reach = 2 * static_cast<int>(std::ceil(2.0 * std_px));
  const auto along = [&](const capture::RawFrame& from, int dx, int dy) {
    capture::RawFrame out = from;
    for (int y = reach; y < from.height_px - reach; ++y) {
      for (int x = reach; x < from.width_px - reach; ++x) {
        double sum = 0.0, weight = 0.0;
        for (int k = -reach; k <= reach; k += 2) {
          const double w = std::exp(-0.5 * k * k / (std_px * std_px));
          sum += w * from.at(x + k * dx, y + k * dy);
          weight += w;
        }
        out.samples[static_cast<std::size_t>(y * from.width_px + x)] =
            static_cast<std::uint16_t>(std::lround(sum / weight));
      }
    }
    return out;
  };
  return along(along(frame, 1, 0), 0, 1);
}

class FocusTest : public ::testing::Test {
 protected:
  FocusTest()
      : rig_(bodies_rig(480, 1.4, {{"m", plastic()}}, {"cube"})),
        scenes_(bodies_scenes(rig_)),
        pose_(calib::pose_from_points(rig_.scene, rig_.pose)),
        virtual_(rig_, scenes_, VirtualShotOptions{.noise = true}),
        source_(virtual_.source(1)) {}
  capture::RawFrame frame(std::size_t shot_idx) const {
    return std::get<capture::FrameSource>(source_.open)(shot_idx, 0);
  }
  // Size of a pixel on the object.
  double px_mm() const {
    const Eigen::Vector3d center = pose_.camera_from_world * scenes_.at("cube").box.center_mm();
    return center.z() / rig_.scene.camera.intrinsics.fx_px;
  }

  Rig rig_;
  ObjectScenes scenes_;
  PoseResult pose_;
  VirtualShots virtual_;
  capture::ShotSource source_;
};

TEST_F(FocusTest, BlurIsMeasuredOnTheOutline) {
  const SceneShot& shot = rig_.scene.shots[0];
  EXPECT_LT(edge_blur_mm(rig_, scenes_, shot, frame(0), pose_), 0.35 * px_mm());
  EXPECT_NEAR(edge_blur_mm(rig_, scenes_, shot, blurred(frame(0), 2.0), pose_) / px_mm(), 2.0, 0.4);
}

// 2 (0.1 / 1)^2 of sigma_s', as many deviations of sigma_a; refused from 3 % on.
TEST_F(FocusTest, BlurWidensAndRefuses) {
  std::vector<ChannelResult> results(1);
  results[0].material = "m";
  Estimate& e = results[0].estimate;
  e.sigma_s_prime_per_mm = normal_quantity(0.99, 0.01);
  e.sigma_a_per_mm = normal_quantity(0.01, 0.001);
  std::vector<ObservedShot> shots(1);
  shots[0].stated = &rig_.scene.shots[0];
  shots[0].edge_blur_mm = 0.1;
  widen_by_blur(shots, 1000.0, results);
  EXPECT_NEAR(e.sigma_s_prime_per_mm.std, std::hypot(0.01, 0.02 * 0.99), 1e-12);
  EXPECT_NEAR(e.sigma_a_per_mm.std, std::hypot(0.001, 1.98 * 0.001), 1e-12);
  EXPECT_LT(e.correlation, -0.5);
  ASSERT_EQ(e.budget.size(), 1U);
  EXPECT_EQ(e.budget[0].cause, "focus");
  EXPECT_TRUE(e.reasons.empty());
  shots[0].edge_blur_mm = 0.13;
  widen_by_blur(shots, 1000.0, results);
  ASSERT_EQ(e.reasons.size(), 1U);
  EXPECT_THAT(e.reasons[0], HasSubstr("out of focus, or moved during the exposure"));
}

// Refused for another reason, the edges being blurred by half a pixel and by two.
TEST_F(FocusTest, RefusedShotsAreToldToBeBlurred) {
  std::vector<ObservedShot> shots(1);
  shots[0].stated = &rig_.scene.shots[0];
  auto seen = std::make_shared<SeenObject>();
  seen->object = &scenes_.at("cube");
  shots[0].seen = seen;
  shots[0].pose = pose_;
  for (const double blur_px : {0.5, 2.0}) {
    std::vector<ChannelResult> results(1);
    results[0].material = "m";
    results[0].estimate.reasons = {"not explained"};
    shots[0].edge_blur_mm = blur_px * px_mm();
    widen_by_blur(shots, rig_.scene.camera.intrinsics.fx_px, results);
    const std::vector<std::string>& reasons = results[0].estimate.reasons;
    ASSERT_EQ(reasons.size(), blur_px < 1.0 ? 1U : 2U);
    EXPECT_EQ(reasons[0], "not explained");
    if (blur_px > 1.0) {
      EXPECT_THAT(reasons[1], HasSubstr("the edges are blurred by 2 px"));
    }
  }
}

}  // namespace
}  // namespace scattermeter::apps
