#include "core/fit/cell_step.h"

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace scattermeter {
namespace {

constexpr int kAcross = 40;
constexpr Eigen::Index kCellRows = kAcross * kAcross;

std::vector<Eigen::Vector3d> square_mm() {
  std::vector<Eigen::Vector3d> out;
  for (int i = 0; i < kCellRows; ++i) {
    out.emplace_back(0.5 * (i % kAcross), 0.5 * static_cast<double>(i / kAcross), 0.0);
  }
  return out;
}

// Light that falls off along a square, faster where the medium scatters or absorbs more.
ScatteringImage falling_light(double s, double a) {
  ScatteringImage m;
  m.l.resize(kCellRows);
  m.per_log_sigma_s.resize(kCellRows);
  m.per_sigma_a.resize(kCellRows);
  const std::vector<Eigen::Vector3d> at = square_mm();
  for (Eigen::Index j = 0; j < kCellRows; ++j) {
    const double x = at[static_cast<std::size_t>(j)].x(), y = at[static_cast<std::size_t>(j)].y();
    const double l = std::pow(s, 0.2 + 0.03 * x) * std::exp(-a * (2.0 + x + 0.5 * y));
    m.l[j] = l;
    m.per_log_sigma_s[j] = (0.2 + 0.03 * x) * l;
    m.per_sigma_a[j] = -(2.0 + x + 0.5 * y) * l;
  }
  m.variance = 1e-6 * m.l;
  return m;
}

struct FallingLight {
  explicit FallingLight(const Eigen::VectorXd& l) {
    system.l = l;
    system.std_l = Eigen::VectorXd::Constant(kCellRows, 1e-3);
    system.nuisance_columns.resize(kCellRows, 0);
    parts = ShotParts({kCellRows}, square_mm(), std::vector<double>(kCellRows, 0.25), l);
  }
  ScatteringPoint solved(ScatteringPoint at, int steps) const {
    for (int i = 0; i < steps; ++i) {
      at = step_by_cells(system, parts, {0.0}, falling_light(at.sigma_s_per_mm, at.sigma_a_per_mm),
                         at, 2.0)
               .to;
    }
    return at;
  }
  DenseSystem system;
  ShotParts parts;
};

TEST(CellStep, EndsAtTheTruth) {
  const FallingLight light(falling_light(2.0, 0.01).l);
  const ScatteringPoint found = light.solved({1.2, 0.002, 1.0}, 6);
  EXPECT_NEAR(found.sigma_s_per_mm, 2.0, 1e-6);
  EXPECT_NEAR(found.sigma_a_per_mm, 0.01, 1e-8);
}

// Without its column, light along y would be taken for absorption.
TEST(CellStep, LeavesToNuisancesWhatIsTheirs) {
  const ScatteringImage truth = falling_light(2.0, 0.01);
  const std::vector<Eigen::Vector3d> at = square_mm();
  Eigen::VectorXd tilt(kCellRows);
  for (Eigen::Index j = 0; j < kCellRows; ++j) {
    tilt[j] = truth.l[j] * (at[static_cast<std::size_t>(j)].y() - 10.0);
  }
  FallingLight light(truth.l + 2e-3 * tilt);
  const double without = light.solved({1.9, 0.012, 1.0}, 3).sigma_a_per_mm;
  light.system.nuisances = {{"light", 0.1, true, "tilt"}};
  light.system.nuisance_columns = tilt;
  EXPECT_GT(std::abs(without - 0.01), 5e-4);
  EXPECT_NEAR(light.solved({1.9, 0.012, 1.0}, 3).sigma_a_per_mm, 0.01, 2e-5);
}

// The noise of rows is averaged in the cells: one step from nearby ends within three of its own
// deviations, and those are no larger than three times what the rows would leave.
TEST(CellStep, IsAboutAsGoodAsRows) {
  std::mt19937 random(4);
  std::normal_distribution<double> normal;
  Eigen::VectorXd l = falling_light(2.0, 0.01).l;
  for (double& v : l) v += 1e-3 * normal(random);
  const FallingLight light(l);
  const ScatteringPoint at{1.98, 0.0105, 1.0};
  const ScatteringImage image = falling_light(at.sigma_s_per_mm, at.sigma_a_per_mm);
  const ScatteringEquation::Step by_cells =
      step_by_cells(light.system, light.parts, {0.0}, image, at, 1.0);
  const ScatteringEquation equation(light.system, {0.0}, image, at);
  const Eigen::MatrixXd& projection = equation.projection(0);
  const ScatteringEquation::Step by_rows = equation.step(
      {image, image}, projection * image.variance.asDiagonal() * projection.transpose(), at);
  const Eigen::Vector2d std = by_cells.covariance.diagonal().cwiseSqrt();
  EXPECT_LT(std::abs(std::log(by_cells.to.sigma_s_per_mm / 2.0)), 3.0 * std[0]);
  EXPECT_LT(std::abs(by_cells.to.sigma_a_per_mm - 0.01), 3.0 * std[1]);
  for (Eigen::Index k = 0; k < 2; ++k) {
    EXPECT_LT(std[k], 3.0 * std::sqrt(by_rows.covariance(k, k)));
    EXPECT_GT(std[k], 0.9 * std::sqrt(by_rows.covariance(k, k)));
  }
}

}  // namespace
}  // namespace scattermeter
