#include "core/estimation/phase_nuisance.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/light/plane_entry.h"
#include "core/scene/surroundings.h"
#include "core/transport/scattering_rows.h"
#include "tests/fixtures/core/simulated_cube.h"

namespace scattermeter {
namespace {

class PhaseOfTheCube : public ::testing::Test {
 protected:
  ScatteringImage paths(const PhaseFunction& phase, std::uint64_t seed, int blocks) {
    const SeenObject& seen = *cube_.shots[0].seen;
    const DiffusePlane plane = plane_below(cube_.scene, *seen.object).in(0);
    const auto source =
        led_entry_above(*seen.object->rays, cube_.scene.lights[0].led()->led, plane, 1.3);
    const ScatteringMedium medium = scattering_medium(medium_, phase);
    const CameraConnection camera =
        CameraConnection(boundary_, seen.camera_center_mm, medium).with(medium, plane);
    ScatteringSum sum(view_, Eigen::MatrixXd(0, view_.n_rows));
    PathOptions options;
    options.seed = seed;
    sum.trace({boundary_, medium, *source, &camera, plane}, options, blocks);
    return sum.image();
  }

  const Medium medium_{0.9, 0.01, 1.3};
  test_support::DipoleCube cube_{1, 2.5};
  const PathBoundary boundary_{*cube_.shots[0].seen->object->rays};
  const ScatteringView view_ =
      scattering_view(*cube_.shots[0].seen->patches, cube_.shots[0].seen->map.patch_of_row);
};

// Paths of isotropic scattering and of Henyey and Greenstein's with g = 0.7: the light of the whole
// image, and of its rows. Without the nuisance, the rows differ by seven times their errors.
TEST_F(PhaseOfTheCube, IsThatOfPaths) {
  cube_.show(medium_);
  const MaterialChannel channel = material_channels(cube_.scene, cube_.shots, "R").front();
  ChannelRows rows = channel_rows(cube_.scene, channel);
  for (ChannelObservation& o : rows) {
    std::fill(o.state.begin(), o.state.end(), RowState::kUsed);
  }
  const DistanceKnots knots = smooth_knots(cube_.lit);
  PhaseNuisance nuisance(cube_.scene, channel, knots);
  nuisance.set_rows(rows);
  const WeightMatrix& weights = cube_.weights.at({cube_.shots[0].seen.get(), "led", 0});
  const ScatteringPoint at{medium_.sigma_s_prime_per_mm, medium_.sigma_a_per_mm, 1.0};
  const double power = cube_.scene.lights[0]->power()[0];
  constexpr double kG = 0.7;
  const Eigen::VectorXd expected = kG * nuisance.change(weights, at);
  const ScatteringImage even = paths(0.0, 1, 150), ahead = paths(kG, 2, 150);
  const Eigen::VectorXd change = ahead.l - even.l;
  const Eigen::VectorXd variance = even.variance + ahead.variance;
  const auto n = static_cast<double>(change.size());
  const double without = change.cwiseAbs2().cwiseQuotient(variance).sum() / n;
  const double with = (change - expected).cwiseAbs2().cwiseQuotient(variance).sum() / n;
  EXPECT_NEAR(power, 1.0, 1e-12);
  EXPECT_GT(without, 3.0);
  EXPECT_LT(with, 1.8);
  EXPECT_NEAR(expected.sum() / even.l.sum(), change.sum() / even.l.sum(), 0.012);
}

}  // namespace
}  // namespace scattermeter
