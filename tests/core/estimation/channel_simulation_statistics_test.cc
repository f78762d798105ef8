#include <cmath>
#include <cstddef>

#include <gtest/gtest.h>

#include "core/estimation/channel_simulation.h"
#include "core/scene/surroundings.h"
#include "tests/fixtures/core/simulated_cube.h"
#include "tests/fixtures/core/traced_image.h"

namespace scattermeter {
namespace {

using test_support::SimulatedCube;

// Midway between two nodes and elsewhere: as paths of that very medium.
TEST(ChannelSimulationStatistics, BetweenNodesTheLightIsThatOfTheMedium) {
  SimulatedCube c;
  const SeenObject& seen = *c.cube.shots[0].seen;
  const DiffusePlane plane = plane_below(c.cube.scene, *seen.object).in(0);
  const Eigen::Index n = static_cast<Eigen::Index>(c.rows[0].rows_used);
  for (const ScatteringPoint& at :
       {ScatteringPoint{std::exp(0.5 * TransportAtlas::kSpacing), 0.02},
        ScatteringPoint{std::exp(-2.4 * TransportAtlas::kSpacing), 0.1}}) {
    const ScatteringMedium medium{at.sigma_s_per_mm, at.sigma_a_per_mm, 0.0, 1.3};
    const ScatteringImage direct =
        test_support::traced_image(seen, c.cube.scene.lights[0].led()->led, medium, plane, 77, 100);
    const ScatteringImage image = c.look(100, at).image;
    double chi2 = 0.0, light = 0.0, expected = 0.0;
    Eigen::Index row = 0;
    for (std::size_t j = 0; j < c.rows[0].state.size(); ++j) {
      if (c.rows[0].state[j] != RowState::kUsed) continue;
      const auto k = static_cast<Eigen::Index>(j);
      const double area = c.simulation->area_mm2()[static_cast<std::size_t>(row)];
      chi2 += std::pow(image.l[row] - direct.l[k], 2) / (image.variance[row] + direct.variance[k]) /
              static_cast<double>(n);
      light += area * image.l[row];
      expected += area * direct.l[k];
      ++row;
    }
    // One in 2000 on either side, for the 26 rows if they were independent.
    EXPECT_EQ(n, 26);
    EXPECT_GT(chi2, 0.32);
    EXPECT_LT(chi2, 2.1);
    EXPECT_NEAR(light / expected, 1.0, 0.006);
  }
}

}  // namespace
}  // namespace scattermeter
