#include "core/fit/recovered_reflectance.h"

#include <Eigen/QR>
#include <gtest/gtest.h>

#include "tests/fixtures/core/half_lit_plate.h"

namespace scattermeter {
namespace {

// The chi-square of any candidate r on the image equals the one in r's own coordinates.
TEST(RecoveredReflectance, KeepsTheImagesChiSquare) {
  std::mt19937 random(4);
  std::normal_distribution<double> normal;
  DenseSystem system{WeightMatrix(200, 9), Eigen::VectorXd(200), Eigen::VectorXd(200)};
  for (auto& v : system.weights.reshaped()) v = normal(random);
  for (auto& v : system.l) v = normal(random);
  for (auto& v : system.std_l) v = 0.5 + normal(random) * normal(random);
  const RecoveredReflectance recovered = recover_reflectance(system);
  EXPECT_EQ(recovered.whitened.size(), 9);
  const Eigen::VectorXd candidate = Eigen::VectorXd::LinSpaced(9, -1.0, 2.0);
  const double image =
      (system.l - system.weights * candidate).cwiseQuotient(system.std_l).squaredNorm();
  const double own = (recovered.sqrt_information * candidate - recovered.whitened).squaredNorm() +
                     recovered.floor_chi2;
  EXPECT_NEAR(own, image, 1e-9 * image);
  // And values() is the weighted least-squares solution.
  const Eigen::MatrixXd w =
      system.std_l.cwiseInverse().asDiagonal() * Eigen::MatrixXd(system.weights);
  const Eigen::VectorXd direct =
      w.colPivHouseholderQr().solve(system.l.cwiseQuotient(system.std_l));
  EXPECT_LT((recovered.values() - direct).norm(), 1e-9);
}

// Columns that no row touches stay zero (minimum norm) and cost no accuracy.
TEST(RecoveredReflectance, LeavesTheUnseenAlone) {
  DenseSystem system{WeightMatrix::Zero(10, 3), Eigen::VectorXd::LinSpaced(10, 1.0, 2.0),
                     Eigen::VectorXd::Constant(10, 0.1)};
  for (int j = 0; j < 10; ++j) system.weights(j, 1) = system.l[j] / 5.0;
  const RecoveredReflectance recovered = recover_reflectance(system);
  EXPECT_EQ(recovered.whitened.size(), 1);
  EXPECT_LT((recovered.values() - Eigen::Vector3d(0, 5, 0)).norm(), 1e-12);
}

TEST(RecoveredReflectance, OfNoLightIsNothing) {
  const DenseSystem system{WeightMatrix::Zero(10, 3), Eigen::VectorXd::Ones(10),
                           Eigen::VectorXd::Ones(10)};
  EXPECT_EQ(recover_reflectance(system).whitened.size(), 0);
}

}  // namespace
}  // namespace scattermeter
