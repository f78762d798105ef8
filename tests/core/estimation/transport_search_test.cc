#include "core/estimation/transport_search.h"

#include <memory>

#include <gtest/gtest.h>

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

ChannelResult searched(test_support::DipoleCube& cube, const EstimateOptions& options,
                       Progress* progress = nullptr) {
  cube.show(test_support::kCubeMedium, 0.01);
  const MaterialChannel channel = material_channels(cube.scene, cube.shots, "R").front();
  ChannelResult result;
  result.estimate.converged = true;
  result.estimate.sigma_s_prime_per_mm.value = 0.9;
  result.estimate.sigma_a_per_mm.value = 0.01;
  result.estimate.scale.value = 1.0;
  result.singles.resize(2);
  const ProgressStage stage(progress, "transport", 1);
  TransportAtlas atlas;
  search_by_transport(cube.scene, channel, handed_over(cube, channel), atlas, options, stage,
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

}  // namespace
}  // namespace scattermeter
