#include "core/fit/marginal_information.h"

#include <limits>
#include <random>
#include <stdexcept>

#include <Eigen/LU>
#include <gtest/gtest.h>

namespace scattermeter {
namespace {

struct NuisanceCase {
  RecoveredReflectance recovered;
  std::vector<Nuisance> nuisances = {
      {"pose", 0.3, true}, {"eta", 1e3, true}, {"method", 0.7, false}};
  Eigen::VectorXd r = Eigen::VectorXd::LinSpaced(5, 2.0, -1.0);
};

NuisanceCase random_case() {
  NuisanceCase c;
  std::mt19937 random(8);
  std::normal_distribution<double> normal;
  c.recovered.sqrt_information.resize(7, 8);
  c.recovered.whitened.resize(7);
  for (double& v : c.recovered.sqrt_information.reshaped()) v = normal(random);
  for (double& v : c.recovered.whitened) v = normal(random);
  return c;
}

// Integrating over nuisances is adding their covariance to the noise's: chi-square
// e^T (1 + C diag(std^2) C^T)^-1 e.
TEST(MarginalInformation, AreAddedNoise) {
  const NuisanceCase c = random_case();
  for (const auto& [use, n] : {std::pair{NuisanceUse::kFitted, 2}, {NuisanceUse::kAll, 3}}) {
    Eigen::MatrixXd noise = Eigen::MatrixXd::Identity(7, 7);
    for (int i = 0; i < n; ++i) {
      const Eigen::VectorXd push =
          c.recovered.sqrt_information.col(5 + i) * c.nuisances[static_cast<std::size_t>(i)].std;
      noise += push * push.transpose();
    }
    const Eigen::VectorXd e = c.recovered.sqrt_information.leftCols(5) * c.r - c.recovered.whitened;
    const MarginalInformation image = marginal_information(c.recovered, c.nuisances, 5, use);
    EXPECT_NEAR((image.kernel * c.r - image.data).squaredNorm(), e.dot(noise.inverse() * e), 1e-6);
    EXPECT_EQ(image.held.cols(), 3 - n);
  }
}

// What is free takes its column out of the image, as a very wide prior does.
TEST(MarginalInformation, FreeOnesHaveNoPrior) {
  NuisanceCase c = random_case();
  const auto chi2 = [&](double std) {
    c.nuisances[1].std = std;
    const MarginalInformation image =
        marginal_information(c.recovered, c.nuisances, 5, NuisanceUse::kAll);
    return (image.kernel * c.r - image.data).squaredNorm();
  };
  const double wide = chi2(1e7);
  EXPECT_NEAR(chi2(std::numeric_limits<double>::infinity()), wide, 1e-6 * wide);
}

TEST(MarginalInformation, OfNoWidthDoNotMove) {
  NuisanceCase c = random_case();
  for (Nuisance& v : c.nuisances) v.std = 0.0;
  const MarginalInformation image =
      marginal_information(c.recovered, c.nuisances, 5, NuisanceUse::kAll);
  EXPECT_EQ(image.kernel, c.recovered.sqrt_information.leftCols(5));
  EXPECT_EQ(image.data, c.recovered.whitened);
  EXPECT_THROW(marginal_information(c.recovered, c.nuisances, 6, NuisanceUse::kAll),
               std::invalid_argument);
}

}  // namespace
}  // namespace scattermeter
