#include "calib/pose/pose_layout.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/calib/pose_scenes.h"

namespace scattermeter::calib {
namespace {

using ::testing::HasSubstr;

std::optional<PoseFault> fault_of(const std::vector<Eigen::Vector3d>& points,
                                  double distance_mm = 180) {
  std::mt19937_64 random(1);
  const Rigid3d pose = camera_looking_at(points.front(), distance_mm, 0.6, 1);
  const std::vector<PointPair> pairs = shot(long_lens(), pose, points, 0, &random);
  return layout_fault(pairs, std::vector<bool>(pairs.size(), true), 0.3);
}

std::vector<Eigen::Vector3d> near_line(double across_mm) {
  std::vector<Eigen::Vector3d> points;
  points.reserve(8);
  for (int i = 0; i < 8; ++i) points.emplace_back(3.0 * i, i % 2 == 0 ? across_mm : -across_mm, 5);
  return points;
}

TEST(LayoutFault, TooFewPoints) {
  const auto fault = fault_of({{0, 0, 0}, {10, 0, 0}, {0, 10, 0}});
  ASSERT_TRUE(fault);
  EXPECT_EQ(fault->status, PoseStatus::kTooFewPoints);
  EXPECT_THAT(fault->message, HasSubstr("got 3"));
}

TEST(LayoutFault, PairsOfTheSamePlaceCountOnce) {
  const auto fault = fault_of({{0, 0, 0}, {10, 0, 0}, {0, 10, 0}, {10, 0, 0}, {0, 0, 0}});
  ASSERT_TRUE(fault);
  EXPECT_EQ(fault->status, PoseStatus::kTooFewPoints);
  EXPECT_THAT(fault->message, HasSubstr("only 3 different positions"));
}

TEST(LayoutFault, OnlyThePairsInUseCount) {
  std::mt19937_64 random(1);
  const auto pairs =
      shot(long_lens(), camera_looking_at({0, 0, 0}, 180, 0.6, 1), cube_points(10), 0, &random);
  std::vector<bool> use(12, false);
  use[0] = use[3] = use[7] = true;
  const auto fault = layout_fault(pairs, use, 0.3);
  ASSERT_TRUE(fault);
  EXPECT_EQ(fault->status, PoseStatus::kTooFewPoints);
}

TEST(LayoutFault, OnePlace) {
  const auto fault = fault_of(std::vector<Eigen::Vector3d>(5, {1e6, 2, 3}));
  ASSERT_TRUE(fault);
  EXPECT_EQ(fault->status, PoseStatus::kCollinear);
  EXPECT_THAT(fault->message, HasSubstr("at one position"));
}

TEST(LayoutFault, ALine) {
  for (const double across_mm : {0.0, 1e-9, 1e-3}) {
    const auto fault = fault_of(near_line(across_mm));
    ASSERT_TRUE(fault) << across_mm;
    EXPECT_EQ(fault->status, PoseStatus::kCollinear);
    EXPECT_THAT(fault->message, HasSubstr("lie on one line"));
  }
  EXPECT_FALSE(fault_of(near_line(1.0)));
}

TEST(LayoutFault, ALineFarFromTheOrigin) {
  std::vector<Eigen::Vector3d> points;
  points.reserve(6);
  for (int i = 0; i < 6; ++i) points.emplace_back(1e6 + i, 2e6 + 2 * i, -3 * i);
  const auto fault = fault_of(points);
  ASSERT_TRUE(fault);
  EXPECT_EQ(fault->status, PoseStatus::kCollinear);
}

TEST(LayoutFault, ImagePointsOnALine) {
  // Seen from within their own plane.
  std::vector<Eigen::Vector3d> points = {{-9, -8, 0}, {8, -9, 0}, {7, 9, 0}, {-6, 5, 0}, {1, 2, 0}};
  Rigid3d pose;
  pose.rotation = Eigen::AngleAxisd(0.5 * EIGEN_PI, Eigen::Vector3d::UnitX());
  pose.translation_mm = {0, 0, 180};
  std::mt19937_64 random(1);
  const auto pairs = shot(long_lens(), pose, points, 0.3, &random);
  const auto fault = layout_fault(pairs, std::vector<bool>(5, true), 0.3);
  ASSERT_TRUE(fault);
  EXPECT_EQ(fault->status, PoseStatus::kCollinear);
  EXPECT_THAT(fault->message, HasSubstr("image points lie on one line"));
}

TEST(LayoutFault, GoodLayoutsPass) {
  EXPECT_FALSE(fault_of(cube_points(10)));
  EXPECT_FALSE(fault_of(square_points(10)));
  EXPECT_FALSE(
      fault_of(square_points(1e-3), 0.018));  // small in mm is not degenerate: the image decides
  // Two pairs of the same place beside four different ones.
  std::vector<Eigen::Vector3d> points = square_points(10);
  points.push_back(points[0]);
  EXPECT_FALSE(fault_of(points));
}

TEST(SeenAsLineFault, ByTheNoise) {
  // rms across the line is 0.01 mm: at 50 px/mm half a pixel, at 200 px/mm two; 3 x 0.3 px between.
  std::mt19937_64 random(1);
  const auto pairs =
      shot(long_lens(), camera_looking_at({0, 0, 0}, 180, 0.6, 1), near_line(0.01), 0, &random);
  const std::vector<bool> all(8, true);
  EXPECT_TRUE(seen_as_line_fault(pairs, all, 50, 0.3));
  EXPECT_FALSE(seen_as_line_fault(pairs, all, 200, 0.3));
  EXPECT_TRUE(seen_as_line_fault(pairs, all, 200, 1.0));
}

}  // namespace
}  // namespace scattermeter::calib
