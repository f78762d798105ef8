#include "core/estimation/channel_simulation.h"

#include <cstddef>

#include <gtest/gtest.h>

#include "tests/fixtures/core/dipole_cube.h"

namespace scattermeter {
namespace {

constexpr ScatteringPoint kSimulated{0.9, 0.01, 1.0};

// Two shots of the cube with large patches, and the simulation of one channel.
struct SimulatedCube {
  explicit SimulatedCube(double power = 1.0, bool same_light = false) {
    for (SceneLight& light : cube.scene.lights) {
      light.led()->led.intensity_W_per_sr.setConstant(power);
    }
    if (same_light) cube.scene.shots[1].lights = {"led"};
    cube.show(test_support::kCubeMedium);
    channel = material_channels(cube.scene, cube.shots, "R").front();
    rows = channel_rows(cube.scene, channel);
    simulation.emplace(cube.scene, channel);
    simulation->set_rows(rows);
  }

  ChannelSimulation::Draw traced(int blocks) {
    const Eigen::Index n = simulation->n_rows();
    ChannelSimulation::Draw draw = simulation->draw(Eigen::MatrixXd::Identity(n, n));
    simulation->trace(draw, kSimulated, blocks);
    return draw;
  }

  test_support::DipoleCube cube{2, 5.0};
  MaterialChannel channel;
  ChannelRows rows;
  std::optional<ChannelSimulation> simulation;
};

TEST(ChannelSimulation, RowsAreTheUsedPatchesShotByShot) {
  SimulatedCube c;
  const SeenObject& seen = *c.cube.shots[0].seen;
  std::size_t at = 0;
  for (std::size_t s = 0; s < 2; ++s) {
    for (std::size_t j = 0; j < c.rows[s].state.size(); ++j) {
      if (c.rows[s].state[j] != RowState::kUsed) continue;
      const int patch = seen.map.patch_of_row[j];
      ASSERT_LT(at, c.simulation->area_mm2().size());
      EXPECT_EQ(c.simulation->area_mm2()[at], seen.patches->area_mm2(patch));
      EXPECT_EQ(c.simulation->center_mm()[at], seen.patches->center_mm(patch));
      ++at;
    }
  }
  EXPECT_EQ(c.simulation->n_rows(), static_cast<Eigen::Index>(at));
}

// Each row's variance is that of the identity's projection, and no two lights share paths.
TEST(ChannelSimulation, CovarianceOfTheRowsHoldsTheirVariances) {
  SimulatedCube c;
  const ChannelSimulation::Draw draw = c.traced(3);
  EXPECT_EQ(draw.blocks(), 3);
  const ScatteringImage image = c.simulation->image(draw);
  const Eigen::MatrixXd covariance = ChannelSimulation::covariance(draw);
  ASSERT_EQ(image.l.size(), c.simulation->n_rows());
  EXPECT_GT(image.l.minCoeff(), 0.0);
  EXPECT_LT((covariance.diagonal() - image.variance).norm(), 1e-9 * image.variance.norm());
  const auto first = static_cast<Eigen::Index>(c.rows[0].rows_used);
  EXPECT_EQ(covariance.topRightCorner(first, covariance.cols() - first).norm(), 0.0);
}

// Lit by 3 W/sr instead of 1: the same paths, three times the light, nine times the variance.
TEST(ChannelSimulation, LightIsProportionalToPower) {
  SimulatedCube one, three(3.0);
  const ScatteringImage a = one.simulation->image(one.traced(2));
  const ScatteringImage b = three.simulation->image(three.traced(2));
  ASSERT_EQ(a.l.size(), b.l.size());
  EXPECT_LT((3.0 * a.l - b.l).norm(), 1e-12 * b.l.norm());
  EXPECT_LT((3.0 * a.per_log_sigma_s - b.per_log_sigma_s).norm(), 1e-12 * b.per_log_sigma_s.norm());
  EXPECT_LT((3.0 * a.per_sigma_a - b.per_sigma_a).norm(), 1e-12 * b.per_sigma_a.norm());
  EXPECT_LT((9.0 * a.variance - b.variance).norm(), 1e-12 * b.variance.norm());
}

TEST(ChannelSimulation, ShotsUnderOneLightShareItsPaths) {
  SimulatedCube c(1.0, true);
  const ScatteringImage image = c.simulation->image(c.traced(2));
  const Eigen::Index half = image.l.size() / 2;
  ASSERT_EQ(c.rows[0].rows_used, c.rows[1].rows_used);
  EXPECT_EQ(image.l.head(half), image.l.tail(half));
}

// Blocks traced in two goes are those of one; another draw has paths of its own.
TEST(ChannelSimulation, BlocksAddUpAndDrawsAreIndependent) {
  SimulatedCube at_once, in_parts;
  const Eigen::VectorXd whole = at_once.simulation->image(at_once.traced(4)).l;
  ChannelSimulation::Draw draw = in_parts.traced(2);
  in_parts.simulation->trace(draw, kSimulated, 2);
  EXPECT_LT((in_parts.simulation->image(draw).l - whole).norm(), 1e-12 * whole.norm());
  const Eigen::VectorXd other = at_once.simulation->image(at_once.traced(4)).l;
  EXPECT_GT((other - whole).norm(), 1e-3 * whole.norm());
  EXPECT_LT((other - whole).norm(), 0.5 * whole.norm());
}

}  // namespace
}  // namespace scattermeter
