#include "core/estimation/sensitivities.h"

#include <gtest/gtest.h>

#include "tests/fixtures/core/cube_estimation.h"

namespace scattermeter {
namespace {

// Red and blue have first estimates of their own, green has none.
TEST(Sensitivities, EachEstimatedChannelHasAColumnOfItsMedium) {
  test_support::DipoleCube cube;
  cube.scene.lights[0].led()->position_std_mm = 0.3;
  cube.show(test_support::kCubeMedium);
  test_support::CubeEstimation run(cube);
  Estimation& e = run.estimation;
  e.results[0].estimate.sigma_s_prime_per_mm.value = 0.9;
  e.results[0].estimate.sigma_a_per_mm.value = 0.01;
  e.results[0].estimate.scale.value = 1.0;
  e.results[2].estimate.sigma_s_prime_per_mm.value = 1.0;
  e.results[2].estimate.sigma_a_per_mm.value = 0.03;
  e.results[2].estimate.scale.value = 0.5;
  const DistanceKnots knots = smooth_knots(cube.lit);
  const auto all = sensitivities(e, {true, false, true}, knots);
  const LightKey key{cube.shots[0].seen.get(), "led", 0};
  ASSERT_EQ(all->by_light.size(), 1U);
  ASSERT_EQ(all->of_channel.size(), 3U);
  EXPECT_TRUE(all->of_channel[1].empty());
  for (const auto& [channel, medium] :
       {std::pair{std::size_t{0}, LitMedium{{0.9, 0.01, 1.0}, 1.0}},
        std::pair{std::size_t{2}, LitMedium{{1.0, 0.03, 1.0}, 0.5}}}) {
    const ChannelSensitivity& own = all->of_channel[channel].at(key);
    EXPECT_EQ(own.sensitivity, &all->by_light.at(key));
    // The same as for this medium alone.
    const LightSensitivity alone = sensitivity(
        *cube.shots[0].seen, cube.weights.at(key),
        changed_images(*cube.shots[0].seen, cube.scene.lights[0], 0, cube.lit, knots, {medium}),
        {medium}, knots);
    const LightSensitivity& s = *own.sensitivity;
    EXPECT_LT((s.l.col(own.medium) - alone.l.col(0)).norm(), 1e-12 * alone.l.norm());
    ASSERT_EQ(s.per_change.size(), 3U);
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_LT((s.per_change[k].col(own.medium) - alone.per_change[k].col(0)).norm(),
                1e-9 * alone.per_change[k].norm());
    }
  }
  // Kept for the next shots of the view.
  EXPECT_EQ(run.kept.changed.at(key).nominal.rows(),
            static_cast<Eigen::Index>(cube.shots[0].seen->sites.size()));
}

}  // namespace
}  // namespace scattermeter
