#include "core/transport/facet_beams.h"

#include <algorithm>
#include <stdexcept>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "core/material/rough_boundary.h"
#include "core/transport/camera_connection.h"
#include "tests/fixtures/core/boxes.h"
#include "tests/fixtures/core/bumps.h"

namespace scattermeter {
namespace {

struct BeamCase {
  TriangleMesh mesh;
  Eigen::Vector3d camera;
  double eta;
};

std::vector<BeamCase> cases() {
  TriangleMesh slivers = test_support::make_bumps(10, 0.3, 3);
  for (Eigen::Vector3d& v : slivers.vertices_mm) v.z() *= 0.02;
  const TriangleMesh bumps = test_support::make_bumps(10, 0.4, 4);
  std::vector<BeamCase> all;
  for (double eta : {1.0, 1.3, 1.8}) {
    all.push_back({test_support::make_sphere(10, 3), {0, -100, 150}, eta});
    all.push_back({test_support::make_cube(), {15, -30, 25}, eta});
    all.push_back({bumps, {11, 11, 9}, eta});
    all.push_back({bumps, {0, 3e4, 1e5}, eta});
    all.push_back({slivers, {12, -8, 2}, eta});
  }
  return all;
}

// Points are put into beams: from a random place of a facet along the refracted ray. Every facet
// that they are put in, at whatever depth, must be among the candidates. As refracted_ray() has it,
// not as the tree bounds it.
TEST(FacetBeams, HoldWhatIsPutInto) {
  RandomStream random(2, 0);
  for (const BeamCase& c : cases()) {
    const FacetBeams beams(c.mesh, c.camera, c.eta);
    ASSERT_GT(beams.facets().size(), 0U);
    for (int i = 0; i < 20'000; ++i) {
      const auto& f = beams.facets()[random.bits() % beams.facets().size()];
      const auto& t = c.mesh.triangles[static_cast<std::size_t>(f.facet_idx)];
      const auto corner = [&](std::size_t k) {
        return c.mesh.vertices_mm[static_cast<std::size_t>(t[k])];
      };
      const double u = i % 3 == 0 ? 1.0 : std::sqrt(random.uniform());  // a side, too
      const double v = i % 9 == 0 ? 1.0 : random.uniform();             // and a corner
      const Eigen::Vector3d p =
          (1.0 - u) * corner(0) + u * (1.0 - v) * corner(1) + u * v * corner(2);
      const Eigen::Vector3d ray = (p - c.camera).normalized();
      const double cos_out = -ray.dot(f.normal);
      const double cos_in = std::sqrt(1.0 - (1.0 - cos_out * cos_out) / (c.eta * c.eta));
      const Eigen::Vector3d inside = (ray + cos_out * f.normal) / c.eta - cos_in * f.normal;
      const double length_mm = 30.0 * std::pow(random.uniform(), 3);
      bool found = false;
      beams.for_candidates(
          p + length_mm * inside, length_mm * (1.0 + 1e-9),
          [&](const FacetBeams::Facet& g) { found = found || g.facet_idx == f.facet_idx; });
      ASSERT_TRUE(found) << f.facet_idx << " at " << length_mm;
    }
  }
}

// The same for beams refracted by tilted microfacets.
TEST(FacetBeams, HoldWhatIsPutIntoTurnedBeams) {
  RandomStream random(2, 1);
  for (const BeamCase& c : cases()) {
    const FacetBeams beams(c.mesh, c.camera, c.eta);
    const RoughBoundary rough(0.5, c.eta);
    for (int i = 0; i < 5'000; ++i) {
      const auto& f = beams.facets()[random.bits() % beams.facets().size()];
      const auto& t = c.mesh.triangles[static_cast<std::size_t>(f.facet_idx)];
      const Eigen::Vector3d p = (c.mesh.vertices_mm[static_cast<std::size_t>(t[0])] +
                                 c.mesh.vertices_mm[static_cast<std::size_t>(t[1])] +
                                 c.mesh.vertices_mm[static_cast<std::size_t>(t[2])]) /
                                3.0;
      const RoughBoundary::Facet tilted = rough.draw_facet(random);
      const auto passage = rough.pass((c.camera - p).normalized(), f.normal, tilted);
      if (!passage) continue;
      const double length_mm = 30.0 * std::pow(random.uniform(), 3);
      bool found = false;
      beams.for_turned_candidates(
          p + length_mm * passage->direction, length_mm * (1.0 + 1e-9),
          std::atan(tilted.tan_tilt) + 1e-9,
          [&](const FacetBeams::Facet& g) { found = found || g.facet_idx == f.facet_idx; });
      ASSERT_TRUE(found) << f.facet_idx << " at " << length_mm << " by " << tilted.tan_tilt;
    }
  }
}

// Few candidates are false, and none comes twice.
TEST(FacetBeams, GiveFewCandidates) {
  const TriangleMesh mesh = test_support::make_sphere(10, 5);
  const FacetBeams beams(mesh, {0, -100, 150}, 1.3);
  RandomStream random(3, 0);
  int candidates = 0;
  constexpr int kPoints = 2000;
  for (int i = 0; i < kPoints; ++i) {
    Eigen::Vector3d x;
    do {
      x = 20.0 * Eigen::Vector3d(random.uniform(), random.uniform(), random.uniform()).array() -
          10.0;
    } while (x.norm() > 9.9);
    std::vector<int> found;
    beams.for_candidates(x, 20.0,
                         [&](const FacetBeams::Facet& f) { found.push_back(f.facet_idx); });
    candidates += static_cast<int>(found.size());
    std::sort(found.begin(), found.end());
    ASSERT_TRUE(std::adjacent_find(found.begin(), found.end()) == found.end());
  }
  EXPECT_LT(candidates, 10 * kPoints);
}

TEST(FacetBeams, RefuseASparserInside) {
  EXPECT_THROW(FacetBeams(test_support::make_cube(), {0, 0, 50}, 0.9), std::invalid_argument);
}

}  // namespace
}  // namespace scattermeter
