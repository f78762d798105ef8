// Shots above a plane, measured with the plane stated, not stated, and stated as black.
#include <algorithm>
#include <cmath>
#include <optional>

#include <gtest/gtest.h>

#include "core/diffusion/dipole_curve.h"
#include "core/estimation/channel_simulation.h"
#include "core/estimation/transport_pilot.h"
#include "core/light/plane_light.h"
#include "tests/fixtures/core/cube_estimation.h"
#include "tests/fixtures/core/traced_image.h"

namespace scattermeter {
namespace {

using test_support::CubeEstimation;
using test_support::DipoleCube;

ScenePlane plane_of(double albedo, double std) {
  ScenePlane plane;
  plane.albedo.setConstant(albedo);
  plane.albedo_std.setConstant(std);
  return plane;
}

// Two shots by the dipole of a medium whose mean free path is below a patch's size, with what a
// plane of this albedo reflects once onto the cube: on the cube's own patches, as any light.
constexpr Medium kOpaque{1.5, 0.03, 1.3};
void show_above_plane(DipoleCube& cube, double albedo) {
  cube.show(kOpaque, 2e-3, 11);
  const DistanceKnots knots = smooth_knots(cube.lit);
  const double t = kOpaque.sigma_t_prime_per_mm();
  const Eigen::VectorXd r = dipole_curve(knots, std::log(t), kOpaque.sigma_a_per_mm / t, 1.3).r;
  for (ObservedShot& shot : cube.shots) {
    const SeenObject& seen = *shot.seen;
    const PlaneLight by_plane(cube.scene.light(shot.stated->lights[0]).led()->led, 0.0,
                              Eigen::Array3d::Constant(albedo), Eigen::Array3d::Zero());
    const IncidentLight light =
        by_plane.illuminate(*seen.patches, *seen.object->rays, 1.3, LightUse::kRender)[0];
    const Eigen::VectorXd l =
        smooth_weights(seen.sites, SourceCloud(light, seen.object->box.center_mm()), knots,
                       pair_options(knots)) *
        r;
    for (std::size_t c = 0; c < kRgb; ++c) {
      ChannelObservation& o = shot.observation.channel[c];
      for (std::size_t j = 0; j < o.l.size(); ++j) {
        o.l[j] += by_plane.power()[static_cast<Eigen::Index>(c)] * l[static_cast<Eigen::Index>(j)];
      }
    }
  }
}

Estimate measured(DipoleCube& cube, const std::optional<ScenePlane>& stated) {
  cube.scene.surroundings.plane = stated;
  CubeEstimation run(cube, "R");
  estimate_dipole(run.estimation);
  return run.estimation.results[0].estimate;
}

double deviations_of_s(const Estimate& e) {
  return (e.sigma_s_prime_per_mm.value - kOpaque.sigma_s_prime_per_mm) / e.sigma_s_prime_per_mm.std;
}
double deviations_of_a(const Estimate& e) {
  return (e.sigma_a_per_mm.value - kOpaque.sigma_a_per_mm) / e.sigma_a_per_mm.std;
}
double surroundings_of_a(const Estimate& e) {
  for (const BudgetLine& line : e.budget) {
    if (line.cause == "surroundings") return line.std_sigma_a_per_mm;
  }
  return 0.0;
}

// A stand that the rig does not mention, from none to one of 0.08.
TEST(SurroundingsShot, DefaultCoversABlackStand) {
  for (const double albedo : {0.0, 0.05, 0.08}) {
    DipoleCube cube(2, 1.0);
    show_above_plane(cube, albedo);
    const Estimate e = measured(cube, std::nullopt);
    ASSERT_TRUE(e.converged) << albedo;
    EXPECT_LT(std::abs(deviations_of_s(e)), 3.0) << albedo;
    EXPECT_LT(std::abs(deviations_of_a(e)), 3.0) << albedo;
    EXPECT_NEAR(e.sigma_a_per_mm.value, kOpaque.sigma_a_per_mm, 0.05 * kOpaque.sigma_a_per_mm);
    EXPECT_GT(surroundings_of_a(e), 0.0);
  }
}

TEST(SurroundingsShot, StatedPlaneIsAccountedFor) {
  DipoleCube cube(2, 1.0);
  show_above_plane(cube, 0.2);
  const Estimate right = measured(cube, plane_of(0.2, 0.02));
  ASSERT_TRUE(right.converged);
  EXPECT_LT(std::abs(deviations_of_s(right)), 3.0);
  EXPECT_LT(std::abs(deviations_of_a(right)), 3.0);
  // Taken as black, the shots are explained far worse, and by another medium.
  const Estimate wrong = measured(cube, plane_of(0.0, 0.0));
  EXPECT_GT(wrong.reduced_chi2, 5.0 * right.reduced_chi2);
  EXPECT_GT(std::abs(wrong.sigma_a_per_mm.value - kOpaque.sigma_a_per_mm),
            3.0 * std::abs(right.sigma_a_per_mm.value - kOpaque.sigma_a_per_mm));
  EXPECT_EQ(surroundings_of_a(wrong), 0.0);
}

// What the search by transport simulates is what paths above the plane give: row by row of large
// patches, of other paths. Without the plane it is not.
TEST(SurroundingsShot, TransportSimulatesThePlane) {
  const ScatteringMedium medium{0.9, 0.02, 0.0, 1.3};
  const DiffusePlane plane{0.0, 0.3, PlaneContact::kAir};
  DipoleCube cube(1, 5.0);
  cube.show({0.9, 0.02, 1.3});
  const SeenObject& seen = *cube.shots[0].seen;
  const ScatteringImage shot = test_support::traced_image(seen, cube.scene.lights[0].led()->led,
                                                          medium, plane, 77'000'000, 40);
  const auto chi2_per_row = [&](const ScenePlane& stated) {
    cube.scene.surroundings.plane = stated;
    const MaterialChannel channel = material_channels(cube.scene, cube.shots, "R").front();
    const ChannelRows rows = channel_rows(cube.scene, channel);
    const DenseSystem system = channel_system(cube.scene, channel, rows, cube.weights, 0.0);
    TransportAtlas atlas;
    ChannelSimulation simulation(cube.scene, channel, atlas);
    simulation.set_rows(rows);
    const Eigen::SparseMatrix<double> none(0, simulation.n_rows());
    const ScatteringImage image =
        simulation
            .look({0.9, 0.02, 1.0}, 40, {none, none},
                  [&](const ScatteringPoint& at) {
                    return dipole_pilot(system.weights, smooth_knots(cube.lit), at, 1.3);
                  })
            .image;
    double chi2 = 0.0;
    Eigen::Index at = 0;
    for (std::size_t j = 0; j < rows[0].state.size(); ++j) {
      if (rows[0].state[j] != RowState::kUsed) continue;
      const auto row = static_cast<Eigen::Index>(j);
      const double difference = image.l[at] - shot.l[row];
      chi2 += difference * difference / (image.variance[at] + shot.variance[row]);
      ++at;
    }
    return chi2 / static_cast<double>(at);
  };
  EXPECT_LT(chi2_per_row(plane_of(0.3, 0.01)), 1.6);
  EXPECT_GT(chi2_per_row(plane_of(0.0, 0.0)), 5.0);
}

}  // namespace
}  // namespace scattermeter
