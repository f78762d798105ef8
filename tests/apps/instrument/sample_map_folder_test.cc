#include "apps/instrument/sample_map_folder.h"

#include <string>

#include <gtest/gtest.h>

#include "core/view/camera_view.h"
#include "tests/fixtures/core/boxes.h"
#include "tests/fixtures/temporary_folder.h"

namespace scattermeter::apps {
namespace {

SampleMap cube_map() {
  const TriangleMesh mesh = test_support::make_cube();
  const RayScene scene(mesh);
  const PatchMesh patches(mesh, 2.0);
  const CameraView view{{161, 163, 600, 600, 80, 80, {}},
                        look_at({40, -90, 120}, {0, 0, 10}, {0, 0, 1})};
  return map_samples(view, scene, patches, 1.3, {1, 0.5, 1.0}, nullptr);
}

void expect_equal(const SampleSpread& a, const SampleSpread& b) {
  EXPECT_EQ(a.share, b.share);
  EXPECT_EQ(a.mean_mm, b.mean_mm);
  EXPECT_EQ(a.covariance_mm2, b.covariance_mm2);
}

// Every digit of every member, of rows with guarded samples too.
TEST(SampleMapFolder, FindsTheMapThatAnotherKept) {
  const TemporaryFolder folder;
  const SampleMap kept = cube_map();
  SampleMapFolder one(folder / "views"), other(folder / "views");
  one.keep("a", kept);
  EXPECT_FALSE(other.find("a"));
  ASSERT_EQ(one.write(), "");
  const auto found = other.find("a");
  ASSERT_TRUE(found);
  EXPECT_EQ(found->x0, kept.x0);
  EXPECT_EQ(found->y0, kept.y0);
  EXPECT_EQ(found->width, kept.width);
  EXPECT_EQ(found->height, kept.height);
  EXPECT_EQ(found->row_of_sample, kept.row_of_sample);
  EXPECT_EQ(found->pi_over_transmittance, kept.pi_over_transmittance);
  EXPECT_EQ(found->patch_of_row, kept.patch_of_row);
  EXPECT_EQ(found->coverage, kept.coverage);
  EXPECT_EQ(found->guarded_of_row, kept.guarded_of_row);
  EXPECT_EQ(found->adjacent_rows, kept.adjacent_rows);
  EXPECT_EQ(found->samples_on_object, kept.samples_on_object);
  EXPECT_EQ(found->samples_guarded, kept.samples_guarded);
  EXPECT_EQ(found->patches_partly_seen, kept.patches_partly_seen);
  ASSERT_EQ(found->samples.size(), kept.samples.size());
  ASSERT_EQ(found->of_quarters.size(), kept.of_quarters.size());
  std::size_t cut = 0;
  for (std::size_t row = 0; row < kept.samples.size(); ++row) {
    expect_equal(found->samples[row], kept.samples[row]);
    ASSERT_EQ(found->of_quarters[row].size(), kept.of_quarters[row].size());
    cut += kept.of_quarters[row].empty() ? 0 : 1;
    for (std::size_t k = 0; k < kept.of_quarters[row].size(); ++k) {
      expect_equal(found->of_quarters[row][k], kept.of_quarters[row][k]);
    }
  }
  EXPECT_GT(cut, 5U);
  EXPECT_GT(kept.samples.size(), cut);
}

// Files with a right digest that end early, or name rows that there are not.
TEST(SampleMapFolder, FindsNoMapInOtherBytes) {
  const TemporaryFolder folder;
  SampleMapFolder maps(folder / "views");
  SampleMap map = cube_map();
  maps.keep("whole", map);
  map.row_of_sample.front() = static_cast<std::int32_t>(map.patch_of_row.size());
  maps.keep("beyond", map);
  map = cube_map();
  map.adjacent_rows.front() = {-1};
  maps.keep("below", map);
  map = cube_map();
  map.coverage.pop_back();
  maps.keep("short", map);
  ASSERT_EQ(maps.write(), "");
  KeptFolder files(folder / "views", ".map");
  const auto bytes = files.find("whole");
  ASSERT_TRUE(bytes);
  for (std::size_t size = 0; size < bytes->size(); size += 1 + bytes->size() / 50) {
    files.keep("cut" + std::to_string(size), bytes->substr(0, size));
  }
  ASSERT_EQ(files.write(), "");
  EXPECT_TRUE(maps.find("whole"));
  for (const char* name : {"beyond", "below", "short"}) EXPECT_FALSE(maps.find(name)) << name;
  for (std::size_t size = 0; size < bytes->size(); size += 1 + bytes->size() / 50) {
    EXPECT_FALSE(maps.find("cut" + std::to_string(size))) << size;
  }
}

}  // namespace
}  // namespace scattermeter::apps
