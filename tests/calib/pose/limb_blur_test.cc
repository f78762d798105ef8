#include "calib/pose/limb_blur.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "core/camera/lens.h"
#include "core/material/fresnel.h"
#include "core/mesh/round_bodies.h"
#include "tests/fixtures/calib/pose_scenes.h"

namespace scattermeter::calib {
namespace {

constexpr double kEta = 1.49;
constexpr int kWidth_px = 240, kHeight_px = 200;

// Blur along rows or columns, in quarters of a pixel.
std::vector<double> blurred(const std::vector<double>& fine, int width, int height, double std,
                            bool along_rows) {
  if (std == 0.0) return fine;
  std::vector<double> out(fine.size());
  const int reach = static_cast<int>(std::ceil(3.0 * std));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      double sum = 0.0, weight = 0.0;
      for (int k = -reach; k <= reach; ++k) {
        const int i = along_rows ? x + k : x, j = along_rows ? y : y + k;
        if (i < 0 || j < 0 || i >= width || j >= height) continue;
        const double w = std::exp(-0.5 * k * k / (std * std));
        sum += w * fine[static_cast<std::size_t>(j * width + i)];
        weight += w;
      }
      out[static_cast<std::size_t>(y * width + x)] = sum / weight;
    }
  }
  return out;
}

// A sphere of which the light inside falls to one side and passes the surface by Fresnel's
// equations, blurred by so much to the right and down: a true sphere, not the mesh.
class LimbBlur : public ::testing::Test {
 protected:
  // Radius of its image, px.
  explicit LimbBlur(double radius_px = 80.0) {
    lens_.width_px = kWidth_px;
    lens_.height_px = kHeight_px;
    lens_.fx_px = lens_.fy_px = radius_px * 18.0;
    lens_.cx_px = 120.2;
    lens_.cy_px = 99.7;
  }

  CfaSamples picture(const Eigen::Vector2d& blur_px, bool is_dark = false) const {
    constexpr int kFine = 4;
    const int width = kFine * kWidth_px, height = kFine * kHeight_px;
    const Lens lens(lens_);
    const Eigen::Vector3d eye = inverse(pose_).translation_mm;
    std::vector<double> fine;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const Eigen::Vector2d at((x + 0.5) / kFine - 0.5, (y + 0.5) / kFine - 0.5);
        fine.push_back(
            is_dark ? 0.0
                    : light(eye, pose_.rotation.conjugate() * lens.unproject(at).homogeneous()));
      }
    }
    fine = blurred(fine, width, height, kFine * blur_px.x(), true);
    fine = blurred(fine, width, height, kFine * blur_px.y(), false);
    CfaSamples s;
    s.width = kWidth_px;
    s.height = kHeight_px;
    s.channel_of_phase = {0, 1, 1, 2};
    s.variance_per_count = 1.0 / 6;
    std::mt19937_64 random(1);
    std::normal_distribution<double> gauss;
    for (int y = 0; y < kHeight_px; ++y) {
      for (int x = 0; x < kWidth_px; ++x) {
        double sum = 0.0;
        for (int j = 0; j < kFine * kFine; ++j) {
          sum += fine[static_cast<std::size_t>((kFine * y + j / kFine) * width + kFine * x +
                                               j % kFine)];
        }
        const double counts = 1500.0 * (0.6 + 0.2 * s.channel(x, y)) * sum / (kFine * kFine);
        const double variance = 1.4 + counts / 6;
        s.signal_counts.push_back(static_cast<float>(counts + std::sqrt(variance) * gauss(random)));
        s.variance_counts2.push_back(static_cast<float>(variance));
        s.clipped.push_back(0);
      }
    }
    return s;
  }

  std::optional<Eigen::Matrix2d> seen_px2(const Eigen::Vector2d& blur_px) const {
    return limb_blur_px2({&scene_, 0, picture(blur_px)}, lens_, pose_, kEta);
  }

  static double light(const Eigen::Vector3d& eye, const Eigen::Vector3d& direction) {
    constexpr double kRadius_mm = 10.0;
    const Eigen::Vector3d center(0.0, 0.0, 10.0);
    const Eigen::Vector3d along = direction.normalized();
    const double nearest = (center - eye).dot(along);
    const double off2 = (center - eye).squaredNorm() - nearest * nearest;
    if (off2 >= kRadius_mm * kRadius_mm) return 0.0;
    const Eigen::Vector3d at = eye + (nearest - std::sqrt(kRadius_mm * kRadius_mm - off2)) * along;
    const Eigen::Vector3d normal = (at - center) / kRadius_mm;
    return (1.0 + 0.4 * normal.x()) * fresnel_transmittance(kEta, -normal.dot(along));
  }

  RayScene scene_{sphere_mesh()};
  Rigid3d pose_ = camera_looking_at({0, 0, 10}, 180, 0.6, 1.2);
  CameraIntrinsics lens_;
};

class LimbBlurOfALargeImage : public LimbBlur {
 protected:
  LimbBlurOfALargeImage() : LimbBlur(95.0) {}
};

TEST_F(LimbBlur, IsThatOfTheImage) {
  for (const double px : {1.0, 1.5, 2.5}) {
    const auto seen = seen_px2({px, px});
    ASSERT_TRUE(seen);
    EXPECT_NEAR(std::sqrt((*seen)(0, 0)), px, 0.15);
    EXPECT_NEAR(std::sqrt((*seen)(1, 1)), px, 0.15);
  }
}

// Though its light falls off over about a pixel.
TEST_F(LimbBlur, IsNoneOfASharpImage) {
  const auto seen = seen_px2({0.0, 0.0});
  ASSERT_TRUE(seen);
  EXPECT_LT(seen->norm(), 0.3 * 0.3);
}

TEST_F(LimbBlurOfALargeImage, HasADirection) {
  const auto seen = seen_px2({1.5, 0.0});
  ASSERT_TRUE(seen);
  EXPECT_NEAR(std::sqrt((*seen)(0, 0)), 1.5, 0.2);
  EXPECT_LT((*seen)(1, 1), 0.5);
}

TEST_F(LimbBlur, DarkContoursTellNothing) {
  EXPECT_FALSE(limb_blur_px2({&scene_, 0, picture({0.0, 0.0}, true)}, lens_, pose_, kEta));
}

}  // namespace
}  // namespace scattermeter::calib
