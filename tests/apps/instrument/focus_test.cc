#include "apps/instrument/focus.h"

#include <array>
#include <cmath>
#include <memory>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "apps/simulation/bodies_rig.h"
#include "apps/simulation/virtual_shots.h"
#include "calib/pose/shot_pose.h"
#include "tests/fixtures/apps/body_rig.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

// Gaussian blur of each phase of the filter array by itself, to the right and down.
capture::RawFrame blurred(const capture::RawFrame& frame, std::array<double, 2> stds_px) {
  const auto along = [&](const capture::RawFrame& from, double std_px, int dx, int dy) {
    const int reach = 2 * static_cast<int>(std::ceil(2.0 * std_px));
    capture::RawFrame out = from;
    if (reach == 0) return out;
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
  return along(along(frame, stds_px[0], 1, 0), stds_px[1], 0, 1);
}

class FocusTest : public ::testing::Test {
 protected:
  explicit FocusTest(const std::string& body = "cube")
      : body_(body),
        rig_(bodies_rig(480, 1.4, {{"m", plastic()}}, {body})),
        scenes_(bodies_scenes(rig_)),
        pose_(calib::pose_from_points(rig_.scene, rig_.pose)),
        virtual_(rig_, scenes_, VirtualShotOptions{.noise = true}),
        source_(virtual_.source(1)) {}
  capture::RawFrame frame(std::size_t shot_idx) const {
    return std::get<capture::FrameSource>(source_.open)(shot_idx, 0);
  }
  // Size of a pixel on the object.
  double px_mm() const {
    const Eigen::Vector3d center = pose_.camera_from_world * scenes_.at(body_).box.center_mm();
    return center.z() / rig_.scene.camera.intrinsics.fx_px;
  }

  std::string body_;
  Rig rig_;
  ObjectScenes scenes_;
  PoseResult pose_;
  VirtualShots virtual_;
  capture::ShotSource source_;
};

TEST_F(FocusTest, BlurIsMeasuredOnTheOutline) {
  const SceneShot& shot = rig_.scene.shots[0];
  const EdgeBlur sharp = edge_blur(rig_, scenes_, shot, frame(0), pose_);
  EXPECT_TRUE(sharp.is_measured);
  EXPECT_LT(sharp.largest_std_mm(), 0.35 * px_mm());
  const EdgeBlur round = edge_blur(rig_, scenes_, shot, blurred(frame(0), {2.0, 2.0}), pose_);
  EXPECT_NEAR(std::sqrt(round.mm2(0, 0)) / px_mm(), 2.0, 0.4);
  EXPECT_NEAR(std::sqrt(round.mm2(1, 1)) / px_mm(), 2.0, 0.4);
}

// As by a camera that moved to the side.
TEST_F(FocusTest, BlurInOneDirectionIsToldFromThatInAll) {
  const EdgeBlur seen =
      edge_blur(rig_, scenes_, rig_.scene.shots[0], blurred(frame(0), {2.0, 0.0}), pose_);
  EXPECT_NEAR(std::sqrt(seen.mm2(0, 0)) / px_mm(), 2.0, 0.4);
  EXPECT_LT(std::sqrt(seen.mm2(1, 1)) / px_mm(), 0.7);
  EXPECT_NEAR(seen.largest_std_mm() / px_mm(), 2.0, 0.4);
}

class FocusOnASphere : public FocusTest {
 protected:
  FocusOnASphere() : FocusTest("sphere") {}
};

TEST_F(FocusOnASphere, BlurIsMeasuredOnTheLimb) {
  const SceneShot& shot = rig_.scene.shots[0];
  const EdgeBlur sharp = edge_blur(rig_, scenes_, shot, frame(0), pose_);
  EXPECT_TRUE(sharp.is_measured);
  EXPECT_LT(sharp.largest_std_mm(), 0.35 * px_mm());
  const EdgeBlur seen = edge_blur(rig_, scenes_, shot, blurred(frame(0), {2.0, 1.0}), pose_);
  EXPECT_NEAR(std::sqrt(seen.mm2(0, 0)) / px_mm(), 2.0, 0.4);
  EXPECT_NEAR(std::sqrt(seen.mm2(1, 1)) / px_mm(), 1.0, 0.4);
}

TEST_F(FocusTest, BlurThatIsNotSmallRefuses) {
  std::vector<ChannelResult> results(1);
  results[0].material = "m";
  Estimate& e = results[0].estimate;
  e.sigma_s_prime_per_mm = normal_quantity(0.99, 0.01);
  e.sigma_a_per_mm = normal_quantity(0.01, 0.001);
  std::vector<ObservedShot> shots(1);
  shots[0].stated = &rig_.scene.shots[0];
  shots[0].edge_blur = EdgeBlur{true, 0.59 * 0.59 * Eigen::Matrix2d::Identity()};
  refuse_blurred(shots, 1000.0, results);
  EXPECT_TRUE(e.reasons.empty());
  shots[0].edge_blur = EdgeBlur{true, Eigen::Matrix2d{{0.61 * 0.61, 0.0}, {0.0, 0.0}}};
  refuse_blurred(shots, 1000.0, results);
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
    shots[0].edge_blur =
        EdgeBlur{true, std::pow(blur_px * px_mm(), 2) * Eigen::Matrix2d::Identity()};
    refuse_blurred(shots, rig_.scene.camera.intrinsics.fx_px, results);
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
