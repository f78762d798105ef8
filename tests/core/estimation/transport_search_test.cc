#include "core/estimation/transport_search.h"

#include <array>
#include <cstddef>
#include <memory>

#include <gtest/gtest.h>
#include <oneapi/tbb/parallel_for.h>

#include "tests/fixtures/core/dipole_cube.h"

namespace scattermeter {
namespace {

// What the dipole hands over, without nuisances.
DipoleSystem handed_over(const test_support::DipoleCube& cube, const MaterialChannel& channel) {
  const auto rows = std::make_shared<const ChannelRows>(channel_rows(cube.scene, channel));
  return {[&cube, &channel, rows] {
            return channel_system(cube.scene, channel, *rows, cube.weights, 0.0);
          },
          smooth_knots(cube.lit), rows};
}

ChannelResult start() {
  ChannelResult result;
  result.estimate.converged = true;
  result.estimate.sigma_s_prime_per_mm.value = 0.9;
  result.estimate.sigma_a_per_mm.value = 0.01;
  result.estimate.scale.value = 1.0;
  result.singles.resize(2);
  return result;
}

ChannelResult searched(test_support::DipoleCube& cube, const EstimateOptions& options,
                       Progress* progress = nullptr) {
  cube.show(test_support::kCubeMedium, 0.01);
  const MaterialChannel channel = material_channels(cube.scene, cube.shots, "R").front();
  ChannelResult result = start();
  const ProgressStage stage(progress, "transport", 1);
  TransportAtlas atlas;
  search_by_transport(cube.scene, channel, handed_over(cube, channel), atlas, true, options, stage,
                      result);
  return result;
}

// Patches of half a face: none is whole within the guarded silhouette and creases.
TEST(TransportSearch, RefusesTooFewWholePatches) {
  test_support::DipoleCube cube(1, 10.0);
  const ChannelResult result = searched(cube, {});
  EXPECT_FALSE(result.estimate.converged);
  EXPECT_TRUE(result.singles.empty());
  ASSERT_EQ(result.estimate.reasons.size(), 1U);
  EXPECT_EQ(result.estimate.reasons[0], "only " + std::to_string(result.estimate.rows) +
                                            " whole patches can be used, at least 20 are needed");
  EXPECT_LT(result.estimate.rows, 20U);
}

TEST(TransportSearch, EndsWithoutTime) {
  test_support::DipoleCube cube(1, 3.0);
  EstimateOptions options;
  options.time_limit_s = 0.0;
  const ChannelResult result = searched(cube, options);
  EXPECT_FALSE(result.estimate.converged);
  EXPECT_GE(result.estimate.rows, 20U);
  ASSERT_EQ(result.estimate.reasons.size(), 1U);
  EXPECT_EQ(result.estimate.reasons[0],
            "transport did not converge in time: check the rig, or allow more time");
}

TEST(TransportSearch, EndsWhereItIsCancelled) {
  class CancelledLater final : public Progress {
   public:
    // Not before the search itself asks.
    bool is_cancelled() const override { return ++asked_ > 1; }

   private:
    mutable int asked_ = 0;
  } progress;
  test_support::DipoleCube cube(1, 3.0);
  EXPECT_THROW(searched(cube, {}, &progress), Cancelled);
}

// With the paths that a search has left, others run side by side and find what it would find again.
TEST(TransportSearch, NeedsNoMorePathsThanItHasTraced) {
  test_support::DipoleCube cube(2, 3.0);
  cube.show(test_support::kCubeMedium, 0.01);
  const MaterialChannel channel = material_channels(cube.scene, cube.shots, "R").front();
  const DipoleSystem system = handed_over(cube, channel);
  EstimateOptions options;
  options.paths = 300'000;
  const ProgressStage stage(nullptr, "transport", 1);
  TransportAtlas atlas;
  const auto search = [&](bool may_trace, ChannelResult& result) {
    return search_by_transport(cube.scene, channel, system, atlas, may_trace, options, stage,
                               result);
  };
  ChannelResult result = start();
  EXPECT_FALSE(search(false, result));
  EXPECT_EQ(result.singles.size(), 2U);
  EXPECT_EQ(result.estimate.sigma_s_prime_per_mm.value, 0.9);
  EXPECT_TRUE(search(true, result));
  ASSERT_GT(result.estimate.rows, 20U);

  ChannelResult again = start();
  EXPECT_TRUE(search(true, again));
  ASSERT_TRUE(again.estimate.converged);
  std::array<ChannelResult, 4> beside = {start(), start(), start(), start()};
  tbb::parallel_for(std::size_t{0}, beside.size(),
                    [&](std::size_t i) { EXPECT_TRUE(search(false, beside[i])); });
  for (const ChannelResult& r : beside) {
    EXPECT_EQ(r.estimate.sigma_s_prime_per_mm.value, again.estimate.sigma_s_prime_per_mm.value);
    EXPECT_EQ(r.estimate.sigma_a_per_mm.std, again.estimate.sigma_a_per_mm.std);
  }
}

}  // namespace
}  // namespace scattermeter
