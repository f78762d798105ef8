#include "apps/bench_transport/atlas_interpolation.h"

#include <cmath>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

TEST(AtlasInterpolation, DrawsMediaAndTellsNoiseFromError) {
  AtlasInterpolationOptions options;
  options.media = 3;
  options.paths = 65'536;
  options.image_width_px = 240;
  const std::vector<AtlasInterpolationRow> rows = atlas_interpolation(options);
  ASSERT_EQ(rows.size(), 3U);
  for (const AtlasInterpolationRow& r : rows) {
    EXPECT_GE(r.medium.sigma_s_prime_per_mm, 0.2);
    EXPECT_LE(r.medium.sigma_s_prime_per_mm, 10.0);
    EXPECT_LE(r.medium.sigma_a_per_mm, r.medium.sigma_s_prime_per_mm);
    EXPECT_EQ(r.paths, 65'536);
    EXPECT_GE(r.atlas_paths, r.paths);
    for (const AtlasDifference* d : {&r.patches, &r.cells}) {
      EXPECT_GT(d->groups, 10);
      EXPECT_GT(d->monte_carlo, 1e-4);
      // Of differences that were noise alone, five deviations or less of about
      // 2 monte_carlo^2 / sqrt(groups).
      EXPECT_LT(std::abs(d->mean_square),
                10.0 * d->monte_carlo * d->monte_carlo / std::sqrt(d->groups));
      EXPECT_LT(std::abs(d->largest), 10.0 * d->monte_carlo);
    }
    EXPECT_LT(r.cells.monte_carlo, 0.5 * r.patches.monte_carlo);
  }
  EXPECT_THAT(atlas_interpolation_table(rows), HasSubstr("cube, 3 media: interpolation is off by"));
  EXPECT_THAT(atlas_interpolation_csv(rows), HasSubstr("\ncube,"));
  options.paths = 4096;
  EXPECT_THROW(atlas_interpolation(options), std::invalid_argument);
}

// The Monte Carlo error counts a sixteenth there.
TEST(AtlasInterpolation, SeesMoreAtTwiceTheSpacing) {
  AtlasInterpolationOptions options;
  options.media = 1;
  options.paths = 32'768;
  options.image_width_px = 240;
  const AtlasInterpolationRow medium = atlas_interpolation(options).front();
  const std::vector<AtlasInterpolationRow> nodes = atlas_interpolation_of_nodes(options);
  ASSERT_EQ(nodes.size(), 5U);
  for (const AtlasInterpolationRow& r : nodes) {
    EXPECT_LT(r.cells.monte_carlo, 0.25 * medium.cells.monte_carlo);
    EXPECT_LT(r.cells.mean_square, 1e-5);
    EXPECT_GT(r.patches.monte_carlo, r.cells.monte_carlo);
  }
  EXPECT_NEAR(nodes[2].medium.sigma_s_prime_per_mm, std::exp(0.35), 1e-9);
}

// 4 and 0: mean 2, deviation of the mean 2; a negative mean is no error, but has a limit.
TEST(AtlasInterpolation, LimitsTheError) {
  const AtlasInterpolationError two = interpolation_error({4.0, 0.0});
  EXPECT_DOUBLE_EQ(two.rms, std::sqrt(2.0));
  EXPECT_DOUBLE_EQ(two.below, std::sqrt(2.0 + 1.645 * 2.0));
  const AtlasInterpolationError none = interpolation_error({-3.0, 1.0});
  EXPECT_EQ(none.rms, 0.0);
  EXPECT_DOUBLE_EQ(none.below, std::sqrt(-1.0 + 1.645 * 2.0));
}

}  // namespace
}  // namespace scattermeter::apps
