#include "calib/led/mirror_sphere.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace scattermeter::calib {
namespace {

TEST(MirrorSphere, ReflectsTheEyeIntoTheLight) {
  std::mt19937_64 generator(1);
  std::uniform_real_distribution<double> place(-100.0, 100.0);
  int found = 0;
  for (int i = 0; i < 500; ++i) {
    const MirrorSphere sphere{{1, 2, 3}, 7.0};
    const Eigen::Vector3d eye(place(generator), place(generator), place(generator));
    const Eigen::Vector3d light(place(generator), place(generator), place(generator));
    const auto p = mirror_point_mm(sphere, eye, light);
    if (!p) continue;
    ++found;
    const Eigen::Vector3d n = (*p - sphere.center_mm) / sphere.radius_mm;
    EXPECT_NEAR(n.norm(), 1.0, 1e-12);
    const Eigen::Vector3d d = (*p - eye).normalized();
    const Eigen::Vector3d mirrored = d - 2.0 * d.dot(n) * n;
    EXPECT_LT((mirrored - (light - *p).normalized()).norm(), 1e-9);
    EXPECT_LT(d.dot(n), 0.0);  // seen from outside
    const auto first = first_point_mm(sphere, eye, *p - eye);
    ASSERT_TRUE(first);
    EXPECT_LT((*first - *p).norm(), 1e-4);  // grazing rays meet it imprecisely
  }
  EXPECT_GT(found, 400);
}

TEST(MirrorSphere, LightBehindTheCameraIsSeenInTheMiddle) {
  const MirrorSphere sphere{{0, 0, 0}, 5.0};
  const auto p = mirror_point_mm(sphere, {0, 0, 50}, {0, 0, 90});
  ASSERT_TRUE(p);
  EXPECT_LT((*p - Eigen::Vector3d(0, 0, 5)).norm(), 1e-12);
}

TEST(MirrorSphere, NothingIsSeenOfWhatTheSphereHides) {
  const MirrorSphere sphere{{0, 0, 0}, 5.0};
  EXPECT_FALSE(mirror_point_mm(sphere, {0, 0, 50}, {0, 0, -90}));
  EXPECT_FALSE(mirror_point_mm(sphere, {0, 0, 50}, {0, 1, -90}));
  EXPECT_FALSE(mirror_point_mm(sphere, {0, 0, 4}, {0, 0, 90}));  // inside
  EXPECT_FALSE(first_point_mm(sphere, {0, 0, 50}, {0, 1, 0}));
  EXPECT_FALSE(first_point_mm(sphere, {0, 0, 50}, {0, 0, 1}));
}

}  // namespace
}  // namespace scattermeter::calib
