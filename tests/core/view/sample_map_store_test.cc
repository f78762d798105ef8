#include "core/view/sample_map_store.h"

#include <functional>
#include <vector>

#include <gtest/gtest.h>

#include "tests/fixtures/core/boxes.h"
#include "tests/fixtures/core/memory_store.h"

namespace scattermeter {
namespace {

// All that a view of a cube follows from.
struct CubeSight {
  TriangleMesh mesh = test_support::make_cube();
  double patch_size_mm = 4.0;
  CameraView view{{161, 163, 300, 301, 80, 81, {}}, look_at({40, -90, 120}, {0, 0, 10}, {0, 0, 1})};
  double eta = 1.3;
  SampleMapOptions options;

  SampleMap map(SampleMapStore* store) const {
    const RayScene scene(mesh);
    return map_samples(view, scene, PatchMesh(mesh, patch_size_mm), eta, options, store);
  }
};

TEST(SampleMapStore, FindsTheSameView) {
  test_support::MemoryStore<SampleMap> store;
  const CubeSight cube;
  const SampleMap made = cube.map(&store), found = cube.map(&store);
  const SampleMap alone =
      map_samples(rays_around(cube.view, cube.mesh, 2 * cube.options.guard_px), RayScene(cube.mesh),
                  PatchMesh(cube.mesh, cube.patch_size_mm), cube.eta, cube.options);
  EXPECT_EQ(store.found, 1);
  EXPECT_GT(made.patch_of_row.size(), 20U);
  for (const SampleMap* map : {&made, &found}) {
    EXPECT_EQ(map->row_of_sample, alone.row_of_sample);
    EXPECT_EQ(map->pi_over_transmittance, alone.pi_over_transmittance);
    EXPECT_EQ(map->coverage, alone.coverage);
  }
}

// Whatever changes a map changes its name.
TEST(SampleMapStore, KeepsEachViewApart) {
  test_support::MemoryStore<SampleMap> store;
  const std::vector<std::function<void(CubeSight&)>> changes{
      [](CubeSight&) {},
      [](CubeSight& c) { c.view.intrinsics.width_px += 2; },
      [](CubeSight& c) { c.view.intrinsics.height_px += 2; },
      [](CubeSight& c) { c.view.intrinsics.fx_px += 0.1; },
      [](CubeSight& c) { c.view.intrinsics.fy_px += 0.1; },
      [](CubeSight& c) { c.view.intrinsics.cx_px += 0.1; },
      [](CubeSight& c) { c.view.intrinsics.cy_px += 0.1; },
      [](CubeSight& c) {
        c.view.intrinsics.distortion = {0.01, 0, 0, 0};
      },
      [](CubeSight& c) { c.view.camera_from_world.translation_mm.x() += 0.01; },
      [](CubeSight& c) {
        c.view.camera_from_world = look_at({41, -90, 120}, {0, 0, 10}, {0, 0, 1});
      },
      [](CubeSight& c) { c.mesh.vertices_mm.front().x() -= 0.01; },
      [](CubeSight& c) { std::swap(c.mesh.triangles.front(), c.mesh.triangles.back()); },
      [](CubeSight& c) { c.patch_size_mm = 3.9; },
      [](CubeSight& c) { c.eta = 1.31; },
      [](CubeSight& c) { c.options.guard_px = 3; },
      [](CubeSight& c) { c.options.min_coverage = 0.7; },
      [](CubeSight& c) { c.options.edge_reach_mm = 0.5; },
      [](CubeSight& c) { c.options.least_cosine = 0.1; },
  };
  for (const auto& change : changes) {
    CubeSight cube;
    change(cube);
    cube.map(&store);
  }
  EXPECT_EQ(store.kept.size(), changes.size());
  EXPECT_EQ(store.found, 0);
}

}  // namespace
}  // namespace scattermeter
