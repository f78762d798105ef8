#include "core/transport/scattering_view.h"

#include <cstdint>

#include <gtest/gtest.h>

#include "tests/fixtures/core/boxes.h"

namespace scattermeter {
namespace {

struct TwoRows {
  TriangleMesh mesh = test_support::make_box({-2, -2, 0}, {2, 2, 3});
  PatchMesh patches{mesh, 1.0};
  ScatteringView view = scattering_view(patches, {7, 3});
};

std::int32_t row_of_patch(const TwoRows& s, int patch) {
  return row_of(s.view, s.mesh, s.patches.facet_idx(patch), s.patches.center_mm(patch));
}

TEST(ScatteringView, RowsAreThePatchesAskedFor) {
  const TwoRows s;
  ASSERT_EQ(s.view.n_rows, 2);
  EXPECT_EQ(s.view.area_mm2[0], s.patches.area_mm2(7));
  EXPECT_EQ(s.view.area_mm2[1], s.patches.area_mm2(3));
}

TEST(ScatteringView, APointLiesOnTheRowOfItsPatch) {
  const TwoRows s;
  EXPECT_EQ(row_of_patch(s, 7), 0);
  EXPECT_EQ(row_of_patch(s, 3), 1);
  EXPECT_EQ(row_of_patch(s, 4), -1);
}

}  // namespace
}  // namespace scattermeter
