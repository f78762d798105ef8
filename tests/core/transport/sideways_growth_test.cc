#include "core/transport/sideways_growth.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/mesh/ray_scene.h"
#include "core/transport/refracted_ray.h"
#include "tests/fixtures/core/boxes.h"

namespace scattermeter {
namespace {

constexpr double kIndex = 1.45;
constexpr int kAcross = 1200;

// Calls f(x, y, area) on a fine grid of a square.
template <class F>
void for_square(double half_mm, const F& f) {
  const double pitch_mm = 2.0 * half_mm / kAcross;
  for (int i = 0; i < kAcross; ++i) {
    for (int j = 0; j < kAcross; ++j) {
      f(-half_mm + (i + 0.5) * pitch_mm, -half_mm + (j + 0.5) * pitch_mm, pitch_mm * pitch_mm);
    }
  }
}

double importance(double x, double y) { return 1.0 + 0.4 * x - 0.2 * y; }

// Light that enters a face evenly and is scattered at a depth, there of some importance: its change
// by eta is that of where it is scattered with the entries held, and that of the border with the
// scatterings held.
TEST(SidewaysGrowth, EntriesAsIfTheyWereHeld) {
  const TriangleMesh mesh = test_support::make_box({-1, -1, -3}, {1, 1, 0});
  const RayScene rays{mesh};
  const PathBoundary boundary(rays);
  constexpr double kDepth = 0.2;
  const Eigen::Vector2d sine_outside(0.6, 0.3);
  const auto tangent = [&](double eta) -> Eigen::Vector2d {
    return sine_outside / std::sqrt(eta * eta - sine_outside.squaredNorm());
  };
  const double cosine = std::sqrt(1.0 - sine_outside.squaredNorm() / (kIndex * kIndex));
  Entry entry;
  entry.direction << sine_outside / kIndex, -cosine;
  entry.normal = Eigen::Vector3d::UnitZ();
  const Eigen::Vector2d moved = kDepth * tangent(kIndex);
  double by_border = 0.0;
  for_square(1.0, [&](double x, double y, double area) {
    entry.position_mm = {x, y, 0.0};
    by_border += area * importance(x + moved.x(), y + moved.y()) *
                 entry_sideways_growth(boundary, entry, kIndex, kDepth / cosine);
  });
  constexpr double kStep = 1e-4;
  const Eigen::Vector2d per_eta =
      kDepth * (tangent(kIndex + kStep) - tangent(kIndex - kStep)) / (2.0 * kStep);
  const double expected = 4.0 * (0.4 * per_eta.x() - 0.2 * per_eta.y());
  EXPECT_LT(expected, -0.05);
  EXPECT_NEAR(by_border, expected, 0.05 * std::abs(expected));
}

// Light scattered along a line at a depth, that the camera sees through a part of a face: by how
// much it grows is what is seen at two indices.
TEST(SidewaysGrowth, PassagesOfAPart) {
  constexpr double kDepth = 0.1, kHeight = 40.0, kStep = 0.1;
  constexpr int kAlong = 400'000;
  const Eigen::Vector3d foot(36, 0, 0);
  const auto holds = [](const Eigen::Vector3d& p) { return std::abs(p.x()) < 1.0; };
  double by_border = 0.0, by_index = 0.0;
  for (int i = 0; i < kAlong; ++i) {
    const double x = -2.0 + 4.0 * (i + 0.5) / kAlong;
    const auto passage = [&](double eta) {
      return passage_to({x, 0.0, -kDepth}, kDepth, Eigen::Vector3d::UnitZ(), foot, kHeight, eta);
    };
    const Passage at = passage(kIndex);
    const double light = importance(x, 0.0) * 4.0 / kAlong;
    if (holds(at.point)) by_border += light * sideways_growth(at.point, at.moved_mm_per_eta, holds);
    for (const double sign : {1.0, -1.0}) {
      if (holds(passage(kIndex + sign * kStep).point)) by_index += sign * light / (2.0 * kStep);
    }
  }
  EXPECT_GT(by_index, 0.02);
  EXPECT_NEAR(by_border, by_index, 0.03 * by_index);
}

// At the inner edge of a body that is not convex a face ends as well; away from edges, and where
// there is no face, nothing changes.
TEST(SidewaysGrowth, EntriesNearEdgesAlone) {
  const TriangleMesh mesh =
      test_support::make_prism({{-2, -2}, {0, -2}, {0, 0}, {2, 0}, {2, 2}, {-2, 2}}, 3);
  const RayScene rays{mesh};
  const PathBoundary boundary(rays);
  Entry entry;
  entry.normal = -Eigen::Vector3d::UnitY();  // of the face at y = 0, which ends at x = 0
  const auto growth = [&](double x, double along_x) {
    entry.position_mm = {x, 0.0, 1.5};
    entry.direction = Eigen::Vector3d(along_x, std::sqrt(1.0 - along_x * along_x), 0.0);
    return entry_sideways_growth(boundary, entry, kIndex, 0.5);
  };
  EXPECT_GT(growth(0.005, 0.4), 0.0);
  EXPECT_LT(growth(0.005, -0.4), 0.0);
  EXPECT_EQ(growth(0.005, 0.0), 0.0);
  EXPECT_EQ(growth(0.5, 0.4), 0.0);
  entry.normal = Eigen::Vector3d(0.6, -0.8, 0.0);  // of no face
  EXPECT_EQ(growth(0.005, 0.4), 0.0);
}

}  // namespace
}  // namespace scattermeter
