#include "core/view/seen_surface.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/fixtures/core/boxes.h"
#include "tests/fixtures/core/pinhole_rays.h"

namespace scattermeter {
namespace {

constexpr int kWidth = 520;

// Guarded by one pixel, with or without edges that may be cut back by 0.5 mm.
SampleMapOptions options(double edge_reach_mm) {
  SampleMapOptions out;
  out.guard_px = 1;
  out.edge_reach_mm = edge_reach_mm;
  return out;
}

// Distance of a point of the cube's surface from the nearest edge of its face.
double to_edge_mm(const Eigen::Vector3d& p) {
  std::array<double, 3> mm{};
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const double low = axis == 2 ? 0.0 : -10.0;
    mm[static_cast<std::size_t>(axis)] = std::min(p[axis] - low, low + 20.0 - p[axis]);
  }
  std::sort(mm.begin(), mm.end());
  return mm[1];
}

// Calls see(point, whether it is inside, with edges reaching 0.5 mm) for the samples that are
// inside without that reach.
template <class See>
void for_samples(const TriangleMesh& mesh, const RayGrid& rays, const See& see) {
  const RayScene scene(mesh);
  const PatchMesh patches(mesh, 1.0);
  const SeenSurface bare(rays, scene, patches, options(0.0));
  const SeenSurface surface(rays, scene, patches, options(0.5));
  for (int y = 0; y < kWidth; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const std::size_t i = surface.index(x, y);
      if (surface.seen(i).patch < 0 || !bare.inside(x, y)) continue;
      see(surface.point(i), surface.inside(x, y));
    }
  }
}

// No sample that near to an edge takes part, however few pixels that is on a slanted face, and no
// other sample is left out.
TEST(SeenSurface, EdgeReachKeepsOffWhatMayBeCut) {
  std::size_t left_out = 0;
  for_samples(test_support::make_cube(),
              test_support::pinhole_rays({40, -90, 120}, {0, 0, 10}, 2200.0, kWidth, kWidth),
              [&](const Eigen::Vector3d& p, bool is_inside) {
                const double mm = to_edge_mm(p);
                if (is_inside) {
                  EXPECT_GT(mm, 0.4);
                } else {
                  ++left_out;
                  EXPECT_LT(mm, 0.8);  // a whole diagonal step more, on the most slanted face
                }
              });
  EXPECT_GT(left_out, 1000U);
}

// A body on a plate: the edge at its foot is not one that is cut back.
TEST(SeenSurface, EdgeReachKeepsConcaveEdges) {
  TriangleMesh mesh = test_support::make_box({-20, -20, 0}, {20, 20, 5});
  const TriangleMesh block = test_support::make_box({-10, 0, 5}, {10, 15, 12});
  const auto first = static_cast<int>(mesh.vertices_mm.size());
  mesh.vertices_mm.insert(mesh.vertices_mm.end(), block.vertices_mm.begin(),
                          block.vertices_mm.end());
  for (const auto& t : block.triangles) {
    mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  }
  std::size_t near_foot = 0;
  for_samples(mesh, test_support::pinhole_rays({0, -90, 120}, {0, 0, 5}, 2200.0, kWidth, kWidth),
              [&](const Eigen::Vector3d& p, bool is_inside) {
                if (std::abs(p.y()) > 0.4 || std::abs(p.x()) > 8.0 || std::abs(p.z() - 5.0) > 0.4) {
                  return;
                }
                ++near_foot;
                EXPECT_TRUE(is_inside) << p.transpose();
              });
  EXPECT_GT(near_foot, 100U);
}

}  // namespace
}  // namespace scattermeter
