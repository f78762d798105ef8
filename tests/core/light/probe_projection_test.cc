#include "core/light/probe_projection.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include <gtest/gtest.h>

namespace scattermeter {
namespace {

constexpr ProbeProjection kAll[] = {ProbeProjection::kEquirectangular, ProbeProjection::kAngularMap,
                                    ProbeProjection::kMirrorBall};

void expect_direction(const ProbeMap& map, double x, double y, const Eigen::Vector3d& expected) {
  EXPECT_LT((map.direction(x, y) - expected).norm(), 1e-12)
      << map.direction(x, y).transpose() << " at " << x << ", " << y;
}

// The axes as the header states them.
TEST(ProbeMap, ShowsTheAxesWhereStated) {
  const ProbeMap sphere(ProbeProjection::kEquirectangular, 200, 100);
  expect_direction(sphere, 100, 50, {0, 1, 0});
  expect_direction(sphere, 150, 50, {1, 0, 0});
  expect_direction(sphere, 50, 50, {-1, 0, 0});
  expect_direction(sphere, 0, 50, {0, -1, 0});
  expect_direction(sphere, 77, 0, {0, 0, 1});
  expect_direction(sphere, 77, 100, {0, 0, -1});
  // The disc stands in the middle of a wider picture.
  const ProbeMap angular(ProbeProjection::kAngularMap, 140, 100);
  expect_direction(angular, 70, 50, {0, 1, 0});
  expect_direction(angular, 95, 50, {1, 0, 0});
  expect_direction(angular, 70, 25, {0, 0, 1});
  expect_direction(angular, 120, 50, {0, -1, 0});
  expect_direction(angular, 1, 1, {0, -1, 0});
  const ProbeMap ball(ProbeProjection::kMirrorBall, 100, 100);
  const double r = 50.0 * std::sqrt(0.5);
  expect_direction(ball, 50, 50, {0, 1, 0});
  expect_direction(ball, 50 + r, 50, {-1, 0, 0});  // mirrored
  expect_direction(ball, 50, 50 - r, {0, 0, 1});
  expect_direction(ball, 50, 100, {0, -1, 0});
}

// The reflection itself: normal of the ball at the place, the camera far away towards +y. The
// camera's right is -x.
TEST(ProbeMap, MirrorBallReflects) {
  const ProbeMap ball(ProbeProjection::kMirrorBall, 100, 100);
  for (const Eigen::Vector2d& at : {Eigen::Vector2d(0.3, -0.2), {-0.7, 0.6}, {0.0, 0.95}}) {
    const Eigen::Vector3d normal(-at.x(), std::sqrt(1.0 - at.squaredNorm()), at.y());
    const Eigen::Vector3d to_camera(0, 1, 0);
    const Eigen::Vector3d reflected = 2.0 * normal.dot(to_camera) * normal - to_camera;
    expect_direction(ball, 50 + 50 * at.x(), 50 - 50 * at.y(), reflected);
  }
}

TEST(ProbeMap, PlaceIsTheInverseOfDirection) {
  for (const ProbeProjection projection : kAll) {
    const ProbeMap map(projection, 64, 64);
    for (int y = 0; y < 64; ++y) {
      for (int x = 0; x < 64; ++x) {
        const Eigen::Vector2d p(x + 0.37, y + 0.81);
        const bool disc = projection != ProbeProjection::kEquirectangular;
        if (disc && (p - Eigen::Vector2d(32, 32)).norm() > 31.99) continue;
        const Eigen::Vector3d d = map.direction(p.x(), p.y());
        EXPECT_NEAR(d.norm(), 1.0, 1e-12);
        // Near the ball's rim a pixel is a few hundredths of a radian of the direction behind.
        EXPECT_LT((map.position_px(3.0 * d) - p).norm(), 1e-6) << p.transpose();
      }
    }
  }
}

// All texels make the sphere; sub-rectangles add up; a single one equals dense quadrature of the
// density sin(theta) dtheta dphi.
TEST(ProbeMap, SolidAnglesMakeTheSphere) {
  for (const ProbeProjection projection : kAll) {
    for (const auto& [w, h] : {std::pair{64, 32}, {37, 37}, {9, 21}}) {
      const ProbeMap map(projection, w, h);
      double sum = 0.0;
      for (int y = 0; y < h; ++y) {
        for (int x = 0; x < w; ++x) {
          const double sr = map.solid_angle_sr({x + 0.0, y + 0.0, x + 1.0, y + 1.0});
          EXPECT_GE(sr, 0.0);
          sum += sr;
        }
      }
      EXPECT_NEAR(sum, 4.0 * std::numbers::pi, 1e-9) << w << " x " << h;
    }
  }
}

// One rectangle through the middle of the disc, one across its rim: against a fine grid in angles,
// counting cells whose place falls inside.
TEST(ProbeMap, SolidAngleOfOneRectangle) {
  for (const ProbeProjection projection : kAll) {
    const ProbeMap map(projection, 40, 40);
    for (const ImageRect& r : {ImageRect{18, 15, 26, 21}, ImageRect{30, 5, 38, 12}}) {
      constexpr int kRows = 1500;
      double sum = 0.0;
      for (int i = 0; i < kRows; ++i) {
        const double z = -1.0 + 2.0 * (i + 0.5) / kRows;
        for (int j = 0; j < 2 * kRows; ++j) {
          const double phi = std::numbers::pi * (j + 0.5) / kRows;
          const double s = std::sqrt(1.0 - z * z);
          const Eigen::Vector2d p = map.position_px({s * std::cos(phi), s * std::sin(phi), z});
          if (p.x() > r.x0 && p.x() < r.x1 && p.y() > r.y0 && p.y() < r.y1) sum += 1.0;
        }
      }
      sum *= 4.0 * std::numbers::pi / (2.0 * kRows * kRows);
      // Counting errs by a share of the cells along the border, some 1e-3 of a rectangle.
      EXPECT_NEAR(map.solid_angle_sr(r), sum, 2e-3 * sum + 1e-4);
    }
  }
}

TEST(ProbeMap, MeanDirectionIsShorterByHalfTheVariance) {
  const ProbeMap map(ProbeProjection::kEquirectangular, 360, 180);
  // One degree square on the equator: sides a, variance a^2 / 12 each way.
  const double a = std::numbers::pi / 180.0;
  const Eigen::Vector3d mean = map.mean_direction({180, 89.5, 181, 90.5});
  EXPECT_NEAR(1.0 - mean.norm(), 0.5 * 2.0 * a * a / 12.0, 1e-8);
}

TEST(ProbeMap, RefusesAnEmptyPicture) {
  EXPECT_THROW(ProbeMap(ProbeProjection::kMirrorBall, 0, 4), std::invalid_argument);
}

}  // namespace
}  // namespace scattermeter
