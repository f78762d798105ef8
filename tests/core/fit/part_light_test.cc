#include "core/fit/part_light.h"

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

namespace scattermeter {
namespace {

constexpr Eigen::Index kLightRows = 512;

ShotParts parts_of(const Eigen::VectorXd& l) {
  std::vector<Eigen::Vector3d> center;
  std::vector<double> area;
  for (Eigen::Index j = 0; j < kLightRows; ++j) {
    center.emplace_back(static_cast<double>(j), 0.0, 0.0);
    area.push_back(1.0 + 0.5 * static_cast<double>(j % 3));
  }
  return ShotParts({kLightRows}, center, area, l);
}

// Light and derivatives of its logarithm that run smoothly along x.
ScatteringImage image(double slope, double s, double a) {
  ScatteringImage m;
  const Eigen::ArrayXd x = Eigen::ArrayXd::LinSpaced(kLightRows, 0.0, 1.0);
  m.l = (-slope * x).exp();
  m.per_log_sigma_s = m.l.array() * s * (1.0 + x);
  m.per_sigma_a = -m.l.array() * a * (2.0 - x);
  m.variance = Eigen::VectorXd::Zero(kLightRows);
  return m;
}

// The dipole's image, set right, is that of the paths to what a part's width leaves; nothing learnt
// changes nothing.
TEST(PartLight, SetsTheDipoleRight) {
  const ScatteringImage truth = image(2.0, 0.4, 30.0);
  const ShotParts parts = parts_of(truth.l);
  const Eigen::MatrixXd none = Eigen::MatrixXd::Zero(parts.n_cells(), parts.n_cells());
  ScatteringImage pilot = image(1.5, 0.1, 50.0);
  const ScatteringImage dipole = pilot;
  PartLight light;
  light.correct(parts, pilot);
  EXPECT_EQ(pilot.l, dipole.l);
  light.learn(parts, truth, none, 16.0, dipole, 16.0);
  light.learn(parts, truth, none, 48.0, dipole, 48.0);
  EXPECT_EQ(light.blocks(), 64.0);
  light.correct(parts, pilot);
  const auto far = [](const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
    return (a - b).norm() / b.norm();
  };
  EXPECT_LT(far(pilot.l, truth.l), 0.02);
  EXPECT_LT(far(pilot.per_log_sigma_s, truth.per_log_sigma_s), 0.03);
  EXPECT_LT(far(pilot.per_sigma_a, truth.per_sigma_a), 0.03);
  EXPECT_GT(far(dipole.per_sigma_a, truth.per_sigma_a), 0.3);
}

// Of noise alone, only the mean of the parts is kept; of what both have seen, all.
TEST(PartLight, KeepsWhatTheOtherHalfConfirms) {
  const ScatteringImage truth = image(2.0, 0.4, 30.0);
  const ShotParts parts = parts_of(truth.l);
  const Eigen::MatrixXd none = Eigen::MatrixXd::Zero(parts.n_cells(), parts.n_cells());
  const ScatteringImage dipole = image(1.5, 0.1, 50.0);
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  std::array<PartLight, 2> light;
  for (PartLight& half : light) {
    ScatteringImage noisy = truth;
    std::vector<double> of_part(static_cast<std::size_t>(parts.n_parts()));
    for (double& v : of_part) v = normal(random);
    for (Eigen::Index j = 0; j < kLightRows; ++j) {
      // What is the same in all parts, and noise.
      const double by_l = dipole.per_log_sigma_s[j] / dipole.l[j] + 0.2;
      noisy.per_log_sigma_s[j] =
          truth.l[j] * (by_l + of_part[static_cast<std::size_t>(parts.part_of_row(j))]);
    }
    half.learn(parts, noisy, none, 16.0, dipole, 16.0);
  }
  PartLight::confirm(light[0], light[1]);
  ScatteringImage pilot = dipole;
  light[0].correct(parts, pilot);
  const auto off = [&](const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
    const Eigen::ArrayXd d = (a - b).array() / truth.l.array();
    return std::sqrt((d - d.mean()).square().mean());
  };
  // Parts are off by 1 as learnt.
  const Eigen::VectorXd expected =
      pilot.l.cwiseProduct(dipole.per_log_sigma_s.cwiseQuotient(dipole.l));
  EXPECT_LT(off(pilot.per_log_sigma_s, expected), 0.5);
  EXPECT_LT((pilot.per_sigma_a - truth.per_sigma_a).norm(), 0.03 * truth.per_sigma_a.norm());
}

// Covariances of blocks add up to that of one; from few blocks no combination of cells is free of
// error, from many it is that of the cells.
TEST(PartLight, CellsErrTogether) {
  const ScatteringImage truth = image(2.0, 0.4, 30.0);
  const ShotParts parts = parts_of(truth.l);
  const Eigen::Index n = parts.n_cells();
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  // Of one block: a common error, and each cell's own.
  const Eigen::MatrixXd block =
      4e-4 * Eigen::MatrixXd::Ones(n, n) + 1e-4 * Eigen::MatrixXd::Identity(n, n);
  const auto from = [&](int blocks) {
    Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(n, n);
    for (int b = 0; b < blocks; ++b) {
      const double common = 0.02 * normal(random);
      Eigen::VectorXd e(n);
      for (double& v : e) v = common + 0.01 * normal(random);
      sum += e * e.transpose();
    }
    return Eigen::MatrixXd(sum / (static_cast<double>(blocks) * blocks));
  };
  PartLight few;
  few.learn(parts, truth, from(8), 8.0, truth, 8.0);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(few.relative_cell_covariance(parts));
  EXPECT_GT(modes.eigenvalues().minCoeff(), 1e-5);
  PartLight many;
  many.learn(parts, truth, from(10'240), 10'240.0, truth, 10'240.0);
  EXPECT_LT((many.relative_cell_covariance(parts) - block).norm(), 0.05 * block.norm());
  // Rows of a cell are off together, by as much as their light.
  const CorrelatedErrors alike =
      correlated_rows(parts, truth.l, many.relative_cell_covariance(parts), 0, kLightRows);
  const Eigen::MatrixXd columns = alike.of_row * alike.root;
  const Eigen::MatrixXd rows = columns * columns.transpose();
  EXPECT_NEAR(rows(0, 0), truth.l[0] * truth.l[0] * many.relative_cell_covariance(parts)(0, 0),
              1e-9);
  EXPECT_NEAR(rows(0, kLightRows - 1),
              truth.l[0] * truth.l[kLightRows - 1] *
                  many.relative_cell_covariance(parts)(parts.cell_of_row(0),
                                                       parts.cell_of_row(kLightRows - 1)),
              1e-9);
  // Some of the rows err as they do among all.
  const CorrelatedErrors some =
      correlated_rows(parts, truth.l, many.relative_cell_covariance(parts), 3, kLightRows - 5);
  const Eigen::MatrixXd of_some = some.of_row * some.root;
  const Eigen::MatrixXd among_all = rows.block(3, 3, kLightRows - 5, kLightRows - 5);
  EXPECT_LT((of_some * of_some.transpose() - among_all).norm(), 1e-9 * among_all.norm());
  // The same paths seen again do not tell more of the correlations.
  PartLight once, again;
  const Eigen::MatrixXd same = from(8);
  once.learn(parts, truth, same, 8.0, truth, 8.0);
  for (int i = 0; i < 40; ++i) again.learn(parts, truth, same, 8.0, truth, 8.0);
  const Eigen::MatrixXd known = once.relative_cell_covariance(parts);
  EXPECT_LT((again.relative_cell_covariance(parts) - known).norm(), 1e-9 * known.norm());
}

}  // namespace
}  // namespace scattermeter
