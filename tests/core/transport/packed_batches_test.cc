#include "core/transport/packed_batches.h"

#include <gtest/gtest.h>

namespace scattermeter {
namespace {

constexpr Eigen::Index kBatches = 16, kPackedRows = 5;

Eigen::MatrixXf about_mean(Eigen::MatrixXf sums) {
  const Eigen::RowVectorXf mean = sums.colwise().mean();
  sums.rowwise() -= mean;
  return sums;
}

// Two additions, three tilts that are nearly alike: any combination departs by a few half steps of
// the differences.
TEST(PackedBatches, CombinesWhatWasAdded) {
  PackedBatches packed(3, kBatches, kPackedRows);
  std::vector<Eigen::MatrixXf> all(3, Eigen::MatrixXf::Zero(kBatches, kPackedRows));
  for (int addition = 0; addition < 2; ++addition) {
    std::vector<Eigen::MatrixXf> sums;
    const Eigen::MatrixXf alike = Eigen::MatrixXf::Random(kBatches, kPackedRows).array() + 20.0F;
    for (std::size_t t = 0; t < 3; ++t) {
      sums.emplace_back(alike + 0.01F * Eigen::MatrixXf::Random(kBatches, kPackedRows));
      sums.back().col(kPackedRows - 1).setConstant(4.0F);
      all[t] += sums.back();
    }
    packed.add(sums);
  }
  const Eigen::Vector3d weights(8.0, -12.0, 5.0);
  const Eigen::MatrixXf exact =
      about_mean(static_cast<float>(weights[0]) * all[0] + static_cast<float>(weights[1]) * all[1] +
                 static_cast<float>(weights[2]) * all[2]);
  const Eigen::MatrixXf combined = packed.combined(weights);
  // The sum of weights is 1, so that the step of what is alike, 2 / 127, counts once; those of the
  // differences are a hundredth of it, but count 7 and 5 times. Each was rounded twice.
  EXPECT_LT((combined - exact).cwiseAbs().maxCoeff(), 2.0 * (0.5 * 2.2 / 127.0) * 1.2);
  EXPECT_GT(exact.cwiseAbs().maxCoeff(), 0.5);
  // A row in which all batches are alike.
  EXPECT_EQ(combined.col(kPackedRows - 1), Eigen::VectorXf::Zero(kBatches));
}

// Batches with normal errors: rounding hardly changes their variance.
TEST(PackedBatches, KeepsTheVariance) {
  constexpr Eigen::Index kMany = 64;
  PackedBatches packed(1, kMany, 200);
  const Eigen::MatrixXf sums = Eigen::MatrixXf::Random(kMany, 200);
  packed.add({sums});
  const Eigen::MatrixXf difference = packed.combined(Eigen::VectorXd::Ones(1)) - about_mean(sums);
  EXPECT_LT(difference.squaredNorm(), 1e-4 * about_mean(sums).squaredNorm());
  EXPECT_GT(difference.squaredNorm(), 0.0);
}

}  // namespace
}  // namespace scattermeter
