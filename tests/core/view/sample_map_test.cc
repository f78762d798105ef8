#include "core/view/sample_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "core/material/fresnel.h"
#include "tests/fixtures/core/boxes.h"
#include "tests/fixtures/core/pinhole_rays.h"

namespace scattermeter {
namespace {

class CubeView : public ::testing::Test {
 protected:
  TriangleMesh mesh_ = test_support::make_cube();
  RayScene scene_{mesh_};
  PatchMesh patches_{mesh_, 1.0};
  RayGrid rays_ = test_support::pinhole_rays({40, -90, 120}, {0, 0, 10}, 2200.0, 520, 520);
};

// Whole patches inside a face are seen with a coverage of 1, up to the jitter of the pixel grid.
TEST_F(CubeView, CoverageOfSeenPatchesIsOne) {
  const SampleMap map = map_samples(rays_, scene_, patches_, 1.3, {0, 0.8});
  ASSERT_GT(map.patch_of_row.size(), 500U);
  double sum = 0.0;
  for (double c : map.coverage) sum += c;
  EXPECT_NEAR(sum / static_cast<double>(map.coverage.size()), 1.0, 0.01);
  // Three faces are seen, the others never.
  for (int patch : map.patch_of_row) {
    const Eigen::Vector3d& n = patches_.normal(patch);
    EXPECT_GT(n.z() + n.x() - n.y(), 0.5);
  }
}

// The faces x = 10, y = -10 and z = 20 are seen at cosines of about 0.21, 0.56 and 0.71, at most
// 0.23, 0.61 and 0.76.
TEST_F(CubeView, SlantingSamplesAreLeftOut) {
  const auto faces = [&](double least_cosine) {
    const SampleMap map = map_samples(rays_, scene_, patches_, 1.3, {0, 0.8, 0.0, least_cosine});
    std::array<bool, 3> seen{};
    for (const int patch : map.patch_of_row) {
      for (std::size_t k = 0; k < 3; ++k) {
        seen[k] = seen[k] || std::abs(patches_.normal(patch)[static_cast<Eigen::Index>(k)]) > 0.5;
      }
    }
    for (std::size_t i = 0; i < map.row_of_sample.size(); ++i) {
      if (map.row_of_sample[i] < 0) continue;
      const int patch = map.patch_of_row[static_cast<std::size_t>(map.row_of_sample[i])];
      const Eigen::Vector3d ray = rays_.directions_in_world[i].cast<double>().normalized();
      EXPECT_GT(-patches_.normal(patch).dot(ray), least_cosine - 1e-6);
    }
    return seen;
  };
  EXPECT_EQ(faces(0.0), (std::array<bool, 3>{true, true, true}));
  EXPECT_EQ(faces(0.35), (std::array<bool, 3>{false, true, true}));
  EXPECT_EQ(faces(0.63), (std::array<bool, 3>{false, false, true}));
}

// Without a guard every row is of whole patches; with one, those along the edges have samples that
// are left out, and no others.
TEST_F(CubeView, GuardedRowsStandAtEdges) {
  const SampleMap bare = map_samples(rays_, scene_, patches_, 1.3, {0, 0.8});
  for (const std::size_t n : bare.guarded_of_row) EXPECT_EQ(n, 0U);
  const SampleMap map = map_samples(rays_, scene_, patches_, 1.3, {2, 0.3});
  ASSERT_EQ(map.guarded_of_row.size(), map.patch_of_row.size());
  std::size_t guarded = 0;
  for (std::size_t row = 0; row < map.guarded_of_row.size(); ++row) {
    const Eigen::Vector3d c = patches_.center_mm(map.patch_of_row[row]);
    const double to_edge_mm = [&] {  // of the face that the patch lies on
      std::vector<double> mm;
      for (int axis = 0; axis < 3; ++axis) {
        const double low = axis == 2 ? 0.0 : -10.0;
        mm.push_back(std::min(c[axis] - low, low + 20.0 - c[axis]));
      }
      std::sort(mm.begin(), mm.end());
      return mm[1];
    }();
    if (map.guarded_of_row[row] == 0) continue;
    ++guarded;
    EXPECT_LT(to_edge_mm, 1.0);
  }
  EXPECT_GT(guarded, 100U);
  EXPECT_LT(guarded, map.patch_of_row.size() / 3);
}

// The mean of the samples lies in the patch, near its centre where the patch is wholly seen.
TEST_F(CubeView, MeansLieInTheirPatches) {
  const SampleMap map = map_samples(rays_, scene_, patches_, 1.3);
  for (std::size_t row = 0; row < map.patch_of_row.size(); ++row) {
    const Eigen::Vector3d d = map.samples[row].mean_mm - patches_.center_mm(map.patch_of_row[row]);
    EXPECT_NEAR(d.dot(patches_.normal(map.patch_of_row[row])), 0.0, 1e-4);
    EXPECT_LT(d.norm(), 0.35);
  }
}

TEST_F(CubeView, SampleFactorIsPiOverTransmittance) {
  const SampleMap map = map_samples(rays_, scene_, patches_, 1.3);
  int tested = 0;
  for (std::size_t i = 0; i < map.row_of_sample.size(); i += 97) {
    if (map.row_of_sample[i] < 0) continue;
    const Eigen::Vector3d d = rays_.directions_in_world[i].cast<double>().normalized();
    const Eigen::Vector3d& n =
        patches_.normal(map.patch_of_row[static_cast<std::size_t>(map.row_of_sample[i])]);
    EXPECT_NEAR(static_cast<double>(map.pi_over_transmittance[i]),
                std::numbers::pi / fresnel_transmittance(1.3, -n.dot(d)), 1e-4);
    ++tested;
  }
  EXPECT_GT(tested, 100);
}

// No sample within the guard of the silhouette or of an edge between faces takes part.
TEST_F(CubeView, GuardKeepsOffEdges) {
  const SampleMap map = map_samples(rays_, scene_, patches_, 1.3, {3, 0.5});
  EXPECT_GT(map.samples_guarded, 1000U);
  const auto face = [&](int x, int y) {
    const RayHit hit = scene_.first_hit(
        rays_.origin_in_world_mm,
        rays_.directions_in_world[static_cast<std::size_t>(y * 520 + x)].cast<double>());
    return hit.facet_idx < 0 ? -1 : hit.facet_idx / 2;  // two triangles a face
  };
  for (int y = 3; y < 517; y += 5) {
    for (int x = 3; x < 517; x += 5) {
      if (map.row_of_sample[static_cast<std::size_t>(y * 520 + x)] < 0) continue;
      for (int k : {-3, 3}) {
        EXPECT_EQ(face(x + k, y), face(x, y));
        EXPECT_EQ(face(x, y + k), face(x, y));
      }
    }
  }
}

TEST_F(CubeView, SeesNothingWhereThereIsNothing) {
  const RayGrid away = test_support::pinhole_rays({40, -90, 120}, {90, -190, 230}, 2200.0, 40, 40);
  const SampleMap map = map_samples(away, scene_, patches_, 1.3);
  EXPECT_TRUE(map.patch_of_row.empty());
  EXPECT_EQ(map.samples_on_object, 0U);
}

}  // namespace
}  // namespace scattermeter
