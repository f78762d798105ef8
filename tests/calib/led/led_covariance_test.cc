#include "calib/led/led_covariance.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/fixtures/calib/led_scenes.h"

namespace scattermeter::calib {
namespace {

// One view, no sphere, no exposure but the spare one: 9 unknowns of the LED, 3 ambient, 6 + 1 + 1
// nuisances.
constexpr Eigen::Index kUnknowns = kLedParameters + 3 + 8;

struct Problem {
  LedScene scene;
  LedSolve what;
  LedSolution solution;
};

// Highlights tell the position to 0.1 mm each, cells all else to 0.01 and the albedo as much.
Problem diagonal_problem() {
  Problem p;
  ShadedCell cell;
  cell.channel = 1;
  p.scene.cells = {cell};
  p.scene.views.resize(1);
  p.what.use_cell = {true};
  p.what.free.fill(true);
  p.what.free_ambient = {true};
  p.solution.nuisances_at = kLedParameters + 3;
  p.solution.highlight_information = Eigen::MatrixXd::Zero(kUnknowns, kUnknowns);
  p.solution.cell_information = Eigen::MatrixXd::Zero(kUnknowns, kUnknowns);
  for (Eigen::Index i = 0; i < 3; ++i) p.solution.highlight_information(i, i) = 100.0;
  for (Eigen::Index i = 3; i < kLedParameters + 3; ++i) p.solution.cell_information(i, i) = 1e4;
  p.solution.tangents = {Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY()};
  return p;
}

TEST(LedCovariance, IsTheInverseOfTheInflatedInformation) {
  const Problem p = diagonal_problem();
  const LedCovariance found = led_covariance(p.scene, p.what, p.solution, 4.0, 9.0);
  ASSERT_TRUE(found.determined);
  for (Eigen::Index i = 0; i < 3; ++i) EXPECT_NEAR(found.covariance(i, i), 4e-2, 1e-14);
  for (Eigen::Index i = 3; i < kLedParameters; ++i) {
    EXPECT_NEAR(found.covariance(i, i), 9e-4, 1e-16);
  }
  // Channel 1 alone has a cell; nuisances keep their priors.
  EXPECT_EQ(found.covariance(kLedParameters, kLedParameters), 0.0);
  EXPECT_NEAR(found.covariance(kLedParameters + 1, kLedParameters + 1), 9e-4, 1e-16);
  for (Eigen::Index i = p.solution.nuisances_at; i < kUnknowns; ++i) {
    EXPECT_NEAR(found.covariance(i, i), 1.0, 1e-14);
  }
}

// Power and albedo act alike: their sum is measured, and the albedo's prior bounds the power.
TEST(LedCovariance, TheAlbedosPriorBoundsThePower) {
  Problem p = diagonal_problem();
  Eigen::VectorXd row = Eigen::VectorXd::Zero(kUnknowns);
  const double albedo_std = 0.02;
  row[kLedLogIntensity] = 100.0;
  row[kUnknowns - 1] = 100.0 * albedo_std;
  p.solution.cell_information(kLedLogIntensity, kLedLogIntensity) = 0.0;
  p.solution.cell_information += row * row.transpose();
  const LedCovariance found = led_covariance(p.scene, p.what, p.solution, 1.0, 1.0);
  ASSERT_TRUE(found.determined);
  EXPECT_NEAR(found.covariance(kLedLogIntensity, kLedLogIntensity), 1e-4 + 4e-4, 1e-12);
  const LedUncertainty known = led_uncertainty(found.covariance, p.solution, {}, true);
  EXPECT_NEAR(known.common[kLedLogIntensity], -albedo_std, 1e-12);
  EXPECT_EQ(led_uncertainty(found.covariance, p.solution, {}, false).common.norm(), 0.0);
}

TEST(LedCovariance, NamesWhatTheDataLeaveOpen) {
  Problem p = diagonal_problem();
  // Exponent and power of the first channel only as their sum.
  Eigen::VectorXd row = Eigen::VectorXd::Zero(kUnknowns);
  row[kLedExponent] = row[kLedLogIntensity] = 100.0;
  for (const Eigen::Index i : {kLedExponent, kLedLogIntensity}) {
    p.solution.cell_information(i, i) = 0.0;
  }
  p.solution.cell_information += row * row.transpose();
  const LedCovariance found = led_covariance(p.scene, p.what, p.solution, 1.0, 1.0);
  EXPECT_FALSE(found.determined);
  EXPECT_TRUE(std::isnan(found.covariance(0, 0)));
  EXPECT_NEAR(std::abs(found.open_combination[kLedExponent]), std::sqrt(0.5), 1e-9);
  EXPECT_NEAR(found.open_combination[kLedExponent], -found.open_combination[kLedLogIntensity],
              1e-9);
  EXPECT_NEAR(found.open_combination.head<3>().norm(), 0.0, 1e-9);
  // Held, the exponent takes no part.
  p.what.free[kLedExponent] = false;
  EXPECT_TRUE(led_covariance(p.scene, p.what, p.solution, 1.0, 1.0).determined);
}

TEST(LedCovariance, FreeAmbientLightIsThatOfCellsInUse) {
  Problem p = diagonal_problem();
  p.scene.cells[0].shot = 2;
  p.what.free_ambient = {true, true, true};
  EXPECT_EQ(free_ambient_indices(p.scene, p.what, p.solution),
            std::set<Eigen::Index>{kLedParameters + 7});
  p.what.use_cell[0] = false;
  EXPECT_TRUE(free_ambient_indices(p.scene, p.what, p.solution).empty());
}

TEST(LedCovariance, TangentsFollowTheAxis) {
  const Problem p = diagonal_problem();
  Led led;
  led.axis = Eigen::Vector3d(0.01, 0.02, -1).normalized();
  const LedUncertainty u =
      led_uncertainty(Eigen::MatrixXd::Identity(kUnknowns, kUnknowns), p.solution, led, false);
  EXPECT_NEAR(u.tangents[0].dot(led.axis), 0.0, 1e-15);
  EXPECT_NEAR(u.tangents[1].dot(led.axis), 0.0, 1e-15);
  EXPECT_NEAR(u.tangents[0].dot(u.tangents[1]), 0.0, 1e-15);
  EXPECT_NEAR(u.tangents[0].x(), 1.0, 1e-3);
}

}  // namespace
}  // namespace scattermeter::calib
