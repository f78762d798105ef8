#include "apps/bench/bench_materials.h"

#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

TEST(BenchMaterials, RightOrRefused) {
  const std::vector<ListedMaterial> list = {{"easy", 'G', {1.2, 0.003, 1.3}}};
  MaterialsBenchOptions options;
  options.image_width_px = 484;

  const std::vector<MaterialsBenchRow> rows = bench_materials(list, options);
  ASSERT_EQ(rows.size(), 2U);  // a scale each
  for (const MaterialsBenchRow& row : rows) EXPECT_EQ(row.verdict, MaterialVerdict::kRight);
  EXPECT_GT(rows[1].estimate.sigma_a_per_mm.std, rows[0].estimate.sigma_a_per_mm.std);
  EXPECT_THAT(materials_bench_table(rows), HasSubstr("2 right, 0 wrong, 0 refused"));
  EXPECT_THAT(materials_bench_csv(rows), HasSubstr("easy,G,1.3,1.2,0.003,0.02,"));
  options.scale_stds = {-1.0};
  EXPECT_THROW(bench_materials(list, options), std::invalid_argument);
}

}  // namespace
}  // namespace scattermeter::apps
