#include "core/mesh/visible_edges.h"

#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>

#include <gtest/gtest.h>

#include "tests/fixtures/core/boxes.h"
#include "tests/fixtures/core/spheres.h"

namespace scattermeter {
namespace {

std::map<EdgeKind, double> lengths_mm(const std::vector<EdgePiece>& pieces) {
  std::map<EdgeKind, double> sum;
  for (const EdgePiece& p : pieces) sum[p.kind] += 2 * p.half_mm.norm();
  return sum;
}

// From before and above, x = 0: front and top are seen. Their outline are six edges, they share
// one.
TEST(VisibleEdges, OfACube) {
  const RayScene scene(test_support::make_cube());
  const Eigen::Vector3d eye(0, -100, 150);
  const auto pieces = visible_edges(scene, eye);
  const auto sum = lengths_mm(pieces);
  EXPECT_NEAR(sum.at(EdgeKind::kContour), 120, 1e-9);
  EXPECT_NEAR(sum.at(EdgeKind::kCrease), 20, 1e-9);
  EXPECT_FALSE(sum.contains(EdgeKind::kStep));
  const Eigen::Vector3d center(0, 0, 10);
  for (const EdgePiece& p : pieces) {
    EXPECT_NEAR(p.outward.norm(), 1, 1e-12);
    EXPECT_NEAR(p.outward.dot(p.half_mm), 0, 1e-12);
    EXPECT_NEAR(p.outward.dot(p.center_mm - eye), 0, 1e-9);
    if (p.kind == EdgeKind::kContour) {
      EXPECT_GT(p.outward.dot(p.center_mm - center), 0);
    }
  }
}

// Coplanar triangles are one facet, and a finer mesh shows the same edges.
TEST(VisibleEdges, DoNotDependOnTheTriangles) {
  const Eigen::Vector3d eye(40, -100, 150);
  const auto coarse = visible_edges(RayScene(test_support::make_cube()), eye);
  const auto fine = visible_edges(RayScene(cut_finer(test_support::make_cube(), 3)), eye);
  EXPECT_NEAR(lengths_mm(coarse).at(EdgeKind::kContour), 120, 1e-9);
  EXPECT_NEAR(lengths_mm(fine).at(EdgeKind::kContour), 120, 1e-9);
  EXPECT_NEAR(lengths_mm(coarse).at(EdgeKind::kCrease), 60, 1e-9);
  EXPECT_NEAR(lengths_mm(fine).at(EdgeKind::kCrease), 60, 1e-9);
  std::map<int, int> lines;
  for (const EdgePiece& p : fine) ++lines[p.line_idx];
  EXPECT_EQ(lines.size(), 9U);
  // A line ends in corners of the cube, however finely it is cut.
  for (const EdgePiece& p : fine) {
    const auto& [from, to] = p.line_end_mm;
    EXPECT_NEAR((to - from).norm(), 20, 1e-9);
    for (const Eigen::Vector3d& end : p.line_end_mm) {
      EXPECT_NEAR((end - Eigen::Vector3d(0, 0, 10)).cwiseAbs().minCoeff(), 10, 1e-9);
    }
    EXPECT_LT((p.center_mm - from).norm() + (to - p.center_mm).norm(), 20 + 1e-9);
  }
}

// One box before another, as one mesh: where its outline lies before the other it is a step, and
// what it hides is not there.
TEST(VisibleEdges, KnowWhatIsBehind) {
  TriangleMesh mesh = test_support::make_box({-20, 10, 0}, {20, 20, 40});
  const TriangleMesh front = test_support::make_box({-5, -20, 0}, {5, -10, 10});
  const auto n = static_cast<int>(mesh.vertices_mm.size());
  mesh.vertices_mm.insert(mesh.vertices_mm.end(), front.vertices_mm.begin(),
                          front.vertices_mm.end());
  for (auto t : front.triangles) mesh.triangles.push_back({t[0] + n, t[1] + n, t[2] + n});
  // Level with the middle of the small box, from before: only the two front faces are seen.
  const auto sum = lengths_mm(visible_edges(RayScene(mesh), {0, -300, 5}));
  // The small one's three upper edges lie before the large one; its lower edge is just below it.
  EXPECT_NEAR(sum.at(EdgeKind::kStep), 30, 3);
  EXPECT_FALSE(sum.contains(EdgeKind::kCrease));
  // Large: two sides and the top; the lower edge but for what the small one hides, and its own.
  EXPECT_NEAR(sum.at(EdgeKind::kContour), 40 + 80 + 10 + 29, 5);
}

TEST(VisibleEdges, ClearanceKeepsAwayFromCorners) {
  const RayScene scene(test_support::make_cube());
  VisibleEdgesOptions options;
  options.clearance_rad = 0.01;  // some 1.8 mm
  const auto sum = lengths_mm(visible_edges(scene, {0, -100, 150}, options));
  EXPECT_LT(sum.at(EdgeKind::kContour), 118);
  EXPECT_GT(sum.at(EdgeKind::kContour), 85);
}

// The outline of a sphere has the length of its tangent circle.
TEST(VisibleEdges, OfASmoothBody) {
  const RayScene scene(test_support::make_sphere(10, 4));
  const auto sum = lengths_mm(visible_edges(scene, {0, -200, 0}));
  const double circle_mm = 2 * std::numbers::pi * 10 * std::sqrt(1 - 0.05 * 0.05);
  // Edges of the mesh go to and fro about it.
  EXPECT_GT(sum.at(EdgeKind::kContour), 0.9 * circle_mm);
  EXPECT_LT(sum.at(EdgeKind::kContour), 1.7 * circle_mm);
  EXPECT_FALSE(sum.contains(EdgeKind::kCrease));
}

TEST(VisibleEdges, RefuseNonsense) {
  const RayScene scene(test_support::make_cube());
  EXPECT_THROW(visible_edges(scene, {0, -100, 150}, {.step_rad = 0}), std::invalid_argument);
  EXPECT_THROW(visible_edges(scene, {0, -100, 150}, {.clearance_rad = -1}), std::invalid_argument);
}

}  // namespace
}  // namespace scattermeter
