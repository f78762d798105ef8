#include <cmath>

#include <gtest/gtest.h>

#include "core/fit/paper_estimator.h"
#include "tests/fixtures/core/cube_estimation.h"

namespace scattermeter {
namespace {

// The estimate is that of the width that re-renders the image best, a point of the paper's grid.
TEST(PaperMethod, TakesTheBestOfAllWidths) {
  test_support::DipoleCube cube(1, 4.0);
  cube.show({2.0, 0.005, 1.3}, 0.01);
  test_support::CubeEstimation run(cube, "R");
  estimate_paper(run.estimation);
  const ChannelResult& result = run.estimation.results[0];
  EXPECT_EQ(result.model, "paper");
  const Estimate& e = result.estimate;
  EXPECT_TRUE(e.converged);
  EXPECT_NEAR(std::remainder(e.sigma_s_prime_per_mm.value, 0.01), 0.0, 1e-9);
  EXPECT_NEAR(std::remainder(e.sigma_a_per_mm.value, 0.001), 0.0, 1e-9);
  const DistanceKnots knots = smooth_knots(cube.lit);
  for (const double width_mm : {0.3, 0.5}) {
    const UniformBins bins(width_mm, cube.lit.longest_distance_mm());
    Weights weights;
    add_weights(
        cube.scene, cube.shots, cube.lit, nullptr,
        [&](const SeenObject& seen, const SourceCloud& sources) {
          return uniform_weights(seen.sites, sources, bins, pair_options(knots));
        },
        weights);
    const MaterialChannel& channel = run.estimation.channels[0];
    const PaperEstimate own = solve_paper(
        channel_system(cube.scene, channel, channel_rows(cube.scene, channel), weights, 0.0),
        width_mm, 1.3);
    EXPECT_GE(e.psnr_db, own.psnr_db - 1e-9) << width_mm;
    EXPECT_EQ(e.rows, own.rows);
  }
  EXPECT_EQ(result.patches_by_state[static_cast<std::size_t>(RowState::kUsed)], e.rows);
}

TEST(PaperMethod, ShotsWithoutAUsedRowAreRefused) {
  test_support::DipoleCube cube(1, 4.0);
  cube.show(test_support::kCubeMedium);
  ChannelObservation& o = cube.shots[0].observation.channel[2];
  o.state.assign(o.state.size(), RowState::kFloor);
  o.rows_used = 0;
  test_support::CubeEstimation run(cube, "B");
  estimate_paper(run.estimation);
  const ChannelResult& result = run.estimation.results[0];
  ASSERT_EQ(result.estimate.reasons.size(), 1U);
  EXPECT_EQ(result.estimate.reasons[0], "no patch can be used");
  EXPECT_EQ(result.patches_by_state[static_cast<std::size_t>(RowState::kFloor)], o.l.size());
}

}  // namespace
}  // namespace scattermeter
