// Shots by paths above a plane, measured with the plane stated, not stated, and stated as black.
#include <algorithm>
#include <cmath>
#include <optional>
#include <random>

#include <gtest/gtest.h>

#include "core/light/plane_entry.h"
#include "core/transport/scattering_rows.h"
#include "tests/fixtures/core/cube_estimation.h"

namespace scattermeter {
namespace {

using test_support::CubeEstimation;
using test_support::DipoleCube;

// Two shots of a cube of this medium on a plane, by paths other than those of the search, with
// normal noise; the scene states the plane of `stated`, or none.
struct ShotsAbovePlane {
  ShotsAbovePlane(const ScatteringMedium& medium, double albedo,
                  const std::optional<ScenePlane>& stated, int blocks)
      : cube(2, 2.5) {
    for (SceneObject& object : cube.scene.objects) {
      object.eta_int_over_ext = medium.eta_int_over_ext;
    }
    cube.show({medium.sigma_s_per_mm, medium.sigma_a_per_mm, medium.eta_int_over_ext}, 5e-3);
    const SeenObject& seen = *cube.shots[0].seen;
    const PathBoundary boundary(*seen.object->rays);
    const DiffusePlane plane{0.0, albedo};
    const CameraConnection camera =
        CameraConnection(boundary, seen.camera_center_mm, medium).with(medium, plane);
    const ScatteringView view = scattering_view(*seen.patches, seen.map.patch_of_row);
    std::mt19937 random(5);
    std::normal_distribution<double> normal;
    for (ObservedShot& shot : cube.shots) {
      const Led& led = cube.scene.light(shot.stated->lights[0]).led()->led;
      const auto source = led_entry_above(*seen.object->rays, led, plane, medium.eta_int_over_ext);
      ScatteringSum sum(view, Eigen::MatrixXd(0, view.n_rows));
      PathOptions options;
      options.seed = 77'000'000 + (&shot - cube.shots.data());
      sum.trace({boundary, medium, *source, &camera, plane}, options, blocks);
      const ScatteringImage image = sum.image();
      ChannelObservation& o = shot.observation.channel[0];
      for (std::size_t j = 0; j < o.l.size(); ++j) {
        const auto row = static_cast<Eigen::Index>(j);
        const double std = 5e-3 * image.l[row];
        o.l[j] = image.l[row] + std * normal(random);
        o.variance[j] = std * std + image.variance[row];
      }
    }
    cube.scene.surroundings.plane = stated;
  }
  DipoleCube cube;
};

ScenePlane plane_of(double albedo, double std) {
  ScenePlane plane;
  plane.albedo.setConstant(albedo);
  plane.albedo_std.setConstant(std);
  return plane;
}

struct Measured {
  Estimate estimate;
  double of_s = 0, of_a = 0;  // errors in stated deviations
};

Measured measured(ShotsAbovePlane& shots, const ScatteringMedium& medium) {
  EstimateOptions options;
  options.paths = 250'000;
  options.time_limit_s = 1e4;  // the paths are the limit
  CubeEstimation run(shots.cube, "R", options);
  run.kept.weights.clear();
  estimate_transport(run.estimation);
  Measured out;
  out.estimate = run.estimation.results[0].estimate;
  const Estimate& e = out.estimate;
  out.of_s = (e.sigma_s_prime_per_mm.value - medium.sigma_s_per_mm) / e.sigma_s_prime_per_mm.std;
  out.of_a = (e.sigma_a_per_mm.value - medium.sigma_a_per_mm) / e.sigma_a_per_mm.std;
  return out;
}

const ScatteringMedium kPlain{1.3, 0.008, 0.0, 1.4};

TEST(SurroundingsShot, StatedPlaneIsAccountedForByTransport) {
  ShotsAbovePlane stated(kPlain, 0.3, plane_of(0.3, 0.01), 120);
  const Measured right = measured(stated, kPlain);
  ASSERT_TRUE(right.estimate.converged);
  EXPECT_LT(std::abs(right.of_s), 3.0);
  EXPECT_LT(std::abs(right.of_a), 3.0);
  EXPECT_LT(right.estimate.sigma_s_prime_per_mm.std, 0.1);
  EXPECT_LT(right.estimate.sigma_a_per_mm.std, 0.001);
  // The same shots with the plane stated as black are off.
  stated.cube.scene.surroundings.plane = plane_of(0.0, 0.0);
  const Measured wrong = measured(stated, kPlain);
  EXPECT_GT(std::abs(wrong.estimate.sigma_a_per_mm.value / 0.008 - 1.0), 0.3);
  EXPECT_GT(wrong.estimate.reduced_chi2, 5.0 * right.estimate.reduced_chi2);
}

// A stand that the rig does not mention.
TEST(SurroundingsShot, DefaultBudgetCoversABlackStand) {
  for (const double albedo : {0.0, 0.05}) {
    ShotsAbovePlane shots(kPlain, albedo, std::nullopt, 120);
    const Measured m = measured(shots, kPlain);
    ASSERT_TRUE(m.estimate.converged) << albedo;
    EXPECT_LT(std::abs(m.of_s), 3.0) << albedo;
    EXPECT_LT(std::abs(m.of_a), 3.0) << albedo;
    const auto& budget = m.estimate.budget;
    EXPECT_TRUE(std::any_of(budget.begin(), budget.end(), [](const BudgetLine& line) {
      return line.cause == "surroundings" && line.std_sigma_a_per_mm > 0.0;
    }));
  }
}

}  // namespace
}  // namespace scattermeter
