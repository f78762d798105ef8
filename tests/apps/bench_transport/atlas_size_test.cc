#include "apps/bench_transport/atlas_size.h"

#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/temporary_folder.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

TEST(AtlasSize, GrowsWithTheRows) {
  const TemporaryFolder folder;
  AtlasSizeOptions options;
  options.image_width_px = 240;
  options.rows = 300;
  options.folder = folder / "few";
  const AtlasSizeRow few = atlas_size(options).front();
  EXPECT_NEAR(static_cast<double>(few.rows), 300.0, 60.0);
  EXPECT_EQ(few.nodes, 15);
  options.rows = 1200;
  options.folder = folder / "many";
  const std::vector<AtlasSizeRow> rows = atlas_size(options);
  const AtlasSizeRow& many = rows.front();
  EXPECT_NEAR(many.disk_bytes / few.disk_bytes,
              static_cast<double>(many.rows) / static_cast<double>(few.rows), 0.05);
  // Four of the nodes, and those that are held at a time; what else the program takes is little.
  EXPECT_GT(many.medium_bytes, 0.1 * many.disk_bytes);
  EXPECT_GE(many.all_bytes, many.medium_bytes);
  EXPECT_LT(many.all_bytes, many.disk_bytes);
  EXPECT_THAT(atlas_size_table(rows), HasSubstr("10^5 rows"));
  EXPECT_THAT(atlas_size_csv(rows), HasSubstr("\ncube,"));
  EXPECT_THROW(atlas_size(options), std::invalid_argument);  // the folder is not new
}

}  // namespace
}  // namespace scattermeter::apps
