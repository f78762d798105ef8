#include "core/estimation/transport_pilot.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "core/material/dipole.h"
#include "core/scene/rough_surfaces.h"
#include "core/scene/surroundings.h"
#include "tests/fixtures/core/derivative_check.h"
#include "tests/fixtures/core/dipole_cube.h"
#include "tests/fixtures/core/plate_system.h"
#include "tests/fixtures/core/traced_image.h"

namespace scattermeter {
namespace {

using test_support::plate;

constexpr double kPilotEta = 1.3;

TEST(TransportPilot, LightIsThatOfTheDipole) {
  const ScatteringImage image = dipole_pilot(plate().w, plate().knots, {1.2, 0.02, 1.0}, kPilotEta);
  const Eigen::VectorXd expected = plate().image({1.2, 0.02, kPilotEta});
  EXPECT_LT((image.l - expected).norm(), 1e-12 * expected.norm());
  EXPECT_EQ(image.variance.size(), 0);
}

TEST(TransportPilot, DerivativesAreThoseOfTheLight) {
  const ScatteringPoint at{1.2, 0.02, 1.0};
  const ScatteringImage image = dipole_pilot(plate().w, plate().knots, at, kPilotEta);
  Eigen::MatrixXd jacobian(image.l.size(), 2);
  jacobian << image.per_log_sigma_s, image.per_sigma_a;
  test_support::expect_derivatives(
      [&](const Eigen::VectorXd& x) {
        return dipole_pilot(plate().w, plate().knots, {std::exp(x[0]), x[1], 1.0}, kPilotEta).l;
      },
      Eigen::Vector2d(std::log(at.sigma_s_per_mm), at.sigma_a_per_mm), jacobian);
}

// Together with the expected coefficients, the instruments of a pilot are halfway between its
// derivatives and these without their detail; a free scale's own derivative is kept.
TEST(TransportPilot, FurtherImagesHaveNoDetail) {
  const ScatteringImage image = dipole_pilot(plate().w, plate().knots, {1.2, 0.02, 1.0}, kPilotEta);
  const auto rows = static_cast<std::size_t>(image.l.size());
  std::vector<Eigen::Vector3d> centers;
  for (std::size_t j = 0; j < rows; ++j) centers.emplace_back(static_cast<double>(j), 0.0, 0.0);
  const ShotParts parts({image.l.size()}, centers, std::vector<double>(rows, 1.0), image.l,
                        {1, 2.0, 1, 2});
  for (const bool is_free : {false, true}) {
    const Eigen::MatrixXd further = further_images(parts, image, is_free);
    EXPECT_EQ(further.col(0), parts.levelled(image.l, image.per_log_sigma_s));
    EXPECT_EQ(further.col(1), parts.levelled(image.l, image.per_sigma_a));
    Eigen::MatrixXd derivatives(image.l.size(), is_free ? 3 : 2);
    derivatives.leftCols(2) << image.per_log_sigma_s, image.per_sigma_a;
    derivatives.rightCols(1) = is_free ? image.l : image.per_sigma_a;
    Eigen::MatrixXd instruments(image.l.size(), derivatives.cols() + further.cols());
    instruments << derivatives, further;
    const Eigen::MatrixXd sums = instruments * expected_coefficients(is_free);
    ASSERT_EQ(sums.cols(), derivatives.cols());
    for (Eigen::Index u = 0; u < 2; ++u) {
      EXPECT_LT((sums.col(u) - 0.5 * (derivatives.col(u) + further.col(u))).norm(),
                1e-12 * sums.col(u).norm());
    }
    if (is_free) {
      EXPECT_EQ(sums.col(2), image.l);
    } else {
      EXPECT_EQ(further.col(2), image.l);
    }
  }
}

// Shares l / area of 2, 4 and none (negative light) of a sum of 12.
TEST(TransportPilot, PathVarianceFollowsLightOverArea) {
  const std::vector<double> area_mm2 = {1.0, 0.5, 2.0};
  const Eigen::VectorXd variance = smooth_path_variance(Eigen::Vector3d(2.0, 2.0, -0.1), area_mm2,
                                                        Eigen::Vector3d(1.0, 8.0, 3.0));
  EXPECT_NEAR(variance[0], 4.0, 1e-14);
  EXPECT_NEAR(variance[1], 8.0, 1e-14);
  EXPECT_EQ(variance[2], 0.0);
}

// Paths with alpha a deviation larger and smaller, 0.45 and 0.15: the light of the whole image, 2.2
// % more by paths and 2.8 % by the column, and of its rows, whose chi-square is 3.3 a row without
// the column and 1.5 with it.
TEST(TransportPilot, FewPathsTeachBadly) {
  EXPECT_NEAR(variance_by_learning(75), 1.9, 0.1);
  EXPECT_LT(variance_by_learning(400), 1.2);
  EXPECT_GE(variance_by_learning(0), variance_by_learning(1));
}

TEST(TransportPilot, RoughnessIsThatOfPaths) {
  const Medium medium{0.9, 0.01, 1.3};
  constexpr double kAlpha = 0.3;
  constexpr double kStd = 0.15;
  test_support::DipoleCube cube(1, 2.5);
  cube.scene.objects.front().surface_alpha = kAlpha;
  cube.scene.objects.front().surface_alpha_std = kStd;
  cube.show(medium);
  const SeenObject& seen = *cube.shots[0].seen;
  const auto paths = [&](double alpha, std::uint64_t seed) {
    constexpr int kBlocks = 150;
    return test_support::traced_image(seen, cube.scene.lights[0].led()->led,
                                      scattering_medium(medium, {}, alpha),
                                      plane_below(cube.scene, *seen.object).in(0), seed, kBlocks);
  };
  std::vector<std::size_t> rows;
  for (std::size_t j = 0; j < seen.sites.size(); ++j) rows.push_back(j);
  const RoughSurfaces surfaces(cube.scene, 0, {{&cube.scene.shots[0], &seen, rows}});
  const auto gloss = [&](double alpha) {
    return row_gloss(cube.scene, cube.scene.shots[0], seen, 0, alpha).l;
  };
  const ScatteringPoint at{medium.sigma_s_prime_per_mm, medium.sigma_a_per_mm, 1.0};
  // Differences of the gloss are taken over half of alpha; it is no part of the paths' light.
  const Eigen::VectorXd expected =
      2.0 * (roughness_change(surfaces, cube.weights.at({&seen, "led", 0}), smooth_knots(cube.lit),
                              at, 1.3) -
             kStd / (0.5 * kAlpha) * (gloss(1.25 * kAlpha) - gloss(0.75 * kAlpha)));
  const ScatteringImage rougher = paths(kAlpha + kStd, 1), smoother = paths(kAlpha - kStd, 2);
  const Eigen::VectorXd change = rougher.l - smoother.l;
  const Eigen::VectorXd variance = rougher.variance + smoother.variance;
  const auto n = static_cast<double>(change.size());
  const double without = change.cwiseAbs2().cwiseQuotient(variance).sum() / n;
  const double with = (change - expected).cwiseAbs2().cwiseQuotient(variance).sum() / n;
  const double sum = smoother.l.sum();
  EXPECT_LT(with, 0.5 * without);
  EXPECT_NEAR(expected.sum() / sum, change.sum() / sum, 0.009);
  EXPECT_GT(change.sum() / sum, 0.015);
}

}  // namespace
}  // namespace scattermeter
