#include "core/view/row_selection.h"

#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>
#include <stdexcept>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace scattermeter {
namespace {

ChannelObservation rows(std::vector<double> l, std::vector<double> variance,
                        std::vector<double> per_l) {
  ChannelObservation o;
  o.state.assign(l.size(), RowState::kUsed);
  o.rows_used = l.size();
  o.l = std::move(l);
  o.variance = std::move(variance);
  o.variance_per_l = std::move(per_l);
  return o;
}

TEST(RowSelection, LeavingOutCountsOnce) {
  ChannelObservation o = rows({1, 2, 3}, {1, 1, 1}, {0, 0, 0});
  leave_out(o, 1, RowState::kMirror);
  leave_out(o, 1, RowState::kOutlier);  // stays what it was
  EXPECT_EQ(o.rows_used, 2U);
  EXPECT_EQ(o.state[1], RowState::kMirror);
  EXPECT_THROW(leave_out(o, 3, RowState::kMirror), std::out_of_range);
}

TEST(RowSelection, MirrorsWithinTheCone) {
  const Eigen::Vector3d p(3, -2, 1), n = Eigen::Vector3d(1, 2, 3).normalized();
  const Eigen::Vector3d along = n.cross(Eigen::Vector3d::UnitX()).normalized();
  const Eigen::Vector3d camera = p + 50.0 * (n + along);
  const auto light = [&](double off_rad) {  // 45 degrees and a little, on the other side
    const double angle = 0.25 * std::numbers::pi + off_rad;
    return Eigen::Vector3d(p + 80.0 * (std::cos(angle) * n - std::sin(angle) * along));
  };
  EXPECT_TRUE(mirrors(p, n, camera, light(0.0), 0.01));
  EXPECT_TRUE(mirrors(p, n, camera, light(0.099), 0.1));
  EXPECT_FALSE(mirrors(p, n, camera, light(0.101), 0.1));
  EXPECT_FALSE(mirrors(p, n, camera, light(-0.101), 0.1));
  // Seen or lit from behind nothing is mirrored, though the directions fit.
  EXPECT_FALSE(mirrors(p, -n, camera, light(0.0), 0.1));
  EXPECT_FALSE(
      mirrors(p, n, Eigen::Vector3d(2.0 * p - camera), Eigen::Vector3d(2.0 * p - light(0)), 0.1));
}

// Photon noise by the expected light; what does not depend on light stays.
TEST(RowSelection, ExpectedVariance) {
  //                          dark by chance  negative  as expected  not used
  ChannelObservation o =
      rows({4.0, -1.0, 100.0, 9.0}, {2.0 + 0.5 * 4.0, 2.0, 2.0 + 50.0, 1.0}, {0.5, 0.5, 0.5, 0.5});
  leave_out(o, 3, RowState::kClipped);
  RowSelectionOptions options;
  options.min_snr = 1.0;
  expect(o, Eigen::Vector3d(10.0, 20.0, 100.0), options);
  EXPECT_DOUBLE_EQ(o.variance[0], 2.0 + 0.5 * 10.0);
  EXPECT_DOUBLE_EQ(o.variance[1], 2.0 + 0.5 * 20.0);
  EXPECT_DOUBLE_EQ(o.variance[2], 2.0 + 0.5 * 100.0);
  EXPECT_EQ(o.variance[3], 1.0);
  EXPECT_EQ(o.rows_used, 3U);
  EXPECT_THROW(expect(o, Eigen::Vector4d(1, 1, 1, 1), options), std::invalid_argument);
}

// Three deviations of what is expected, not of what was measured.
TEST(RowSelection, DeepInNoiseIsLeftOut) {
  ChannelObservation o = rows({100.0, 0.1, 4.1, 3.9}, {1, 1, 1, 1}, {0, 0, 0, 0});
  expect(o, Eigen::Vector4d(2.9, 3.1, -5.0, 3.5));
  EXPECT_EQ(o.state[0], RowState::kNoise);
  EXPECT_EQ(o.state[1], RowState::kUsed);
  EXPECT_EQ(o.state[2], RowState::kNoise);
  EXPECT_EQ(o.state[3], RowState::kUsed);
  EXPECT_EQ(o.rows_used, 2U);
}

// Few photons: a row that is dark by chance states a small variance and pulls the level down.
// Variances by expectation do not; nor does it matter that the expectation came from the pulled
// fit, since that is wrong by one factor for all rows.
TEST(RowSelection, ExpectationTakesTheBiasOfFewPhotonsAway) {
  constexpr int kSeeds = 200;
  constexpr int kRows = 300;
  constexpr double kRead = 2.0;  // counts^2
  Eigen::ArrayXd by_measured(kSeeds), by_expected(kSeeds);
  for (int seed = 0; seed < kSeeds; ++seed) {
    std::mt19937 random(static_cast<unsigned>(seed + 1));
    std::normal_distribution<double> read(0.0, std::sqrt(kRead));
    ChannelObservation o = rows(std::vector<double>(kRows), std::vector<double>(kRows),
                                std::vector<double>(kRows, 1.0));
    Eigen::VectorXd shape(kRows);
    for (int j = 0; j < kRows; ++j) {
      shape[j] = 12.0 + 40.0 * j / kRows;
      const auto at = static_cast<std::size_t>(j);
      o.l[at] = std::poisson_distribution<int>(shape[j])(random) + read(random);
      o.variance[at] = kRead + std::max(0.0, o.l[at]);
    }
    const auto level = [&] {
      double up = 0.0, down = 0.0;
      for (std::size_t j = 0; j < o.l.size(); ++j) {
        if (o.state[j] != RowState::kUsed) continue;
        const double m = shape[static_cast<Eigen::Index>(j)];
        up += m * o.l[j] / o.variance[j];
        down += m * m / o.variance[j];
      }
      return up / down;
    };
    by_measured[seed] = level();
    expect(o, by_measured[seed] * shape, {.min_snr = 0.0});
    by_expected[seed] = level();
  }
  const auto error_of_mean = [](const Eigen::ArrayXd& v) {
    return std::sqrt((v - v.mean()).square().mean() / kSeeds);
  };
  std::printf("level by measured variances %.4f, by expected %.4f +- %.4f\n", by_measured.mean(),
              by_expected.mean(), error_of_mean(by_expected));
  // Weight 1 / l instead of 1 / m: a mean lower by about one photon of some 30.
  EXPECT_LT(by_measured.mean(), 0.98);
  EXPECT_NEAR(by_expected.mean(), 1.0, 4.0 * error_of_mean(by_expected));
  EXPECT_LT(error_of_mean(by_expected), 1e-3);
}

class Outliers : public ::testing::Test {
 protected:
  static constexpr Eigen::Index kRows = 1000;
  void SetUp() override {
    std::mt19937 random(11);
    std::normal_distribution<double> normal;
    for (double& v : l_) v = 5.0 + 0.1 * normal(random);
  }
  Eigen::VectorXd l_ = Eigen::VectorXd(kRows);
  Eigen::VectorXd predicted_ = Eigen::VectorXd::Constant(kRows, 5.0);
  Eigen::VectorXd std_ = Eigen::VectorXd::Constant(kRows, 0.1);
};

TEST_F(Outliers, AreFoundOnBothSides) {
  EXPECT_TRUE(outliers(l_, predicted_, std_).empty());
  l_[17] = 5.0 + 0.1 * 7.0;
  l_[900] = 5.0 - 0.1 * 7.0;
  l_[3] = 5.0 + 0.1 * 5.5;
  EXPECT_EQ(outliers(l_, predicted_, std_), (std::vector<Eigen::Index>{17, 900}));
}

// Noise three times what is stated: six stated deviations are two true ones.
TEST_F(Outliers, AreCountedInTheScatterOfAll) {
  std_ /= 3.0;
  EXPECT_TRUE(outliers(l_, predicted_, std_).empty());
  l_[17] = 5.0 + 0.1 * 7.0;
  EXPECT_EQ(outliers(l_, predicted_, std_).size(), 1U);
}

// Noise smaller than stated makes no row an outlier.
TEST_F(Outliers, AreAtLeastTheStatedDeviationsOff) {
  std_ *= 10.0;
  l_[17] = 5.0 + 0.1 * 7.0;
  EXPECT_TRUE(outliers(l_, predicted_, std_).empty());
}

TEST_F(Outliers, ManyAreAWrongModel) {
  for (Eigen::Index j = 0; j < 20; ++j) l_[j * 7] = 9.0;
  EXPECT_EQ(outliers(l_, predicted_, std_).size(), 20U);
  l_[999] = 9.0;
  EXPECT_TRUE(outliers(l_, predicted_, std_).empty());
}

TEST_F(Outliers, NeedEqualLengths) {
  EXPECT_THROW(outliers(l_, predicted_.head(5), std_), std::invalid_argument);
  EXPECT_TRUE(outliers({}, {}, {}).empty());
}

}  // namespace
}  // namespace scattermeter
