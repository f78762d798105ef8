#include "core/view/row_mean.h"

#include <random>

#include <gtest/gtest.h>

namespace scattermeter {
namespace {

double cubic(const Eigen::Vector2i& p) {
  const double x = p.x() - 100.0;
  const double y = p.y() - 50.0;
  return 100.0 + 2.0 * x - 3.0 * y + 0.05 * x * x - 0.08 * x * y + 0.03 * y * y + 0.02 * x * x * x -
         0.01 * x * x * y + 0.015 * x * y * y - 0.03 * y * y * y;
}

double quadratic(const Eigen::Vector2i& p) {
  const double x = p.x();
  const double y = p.y();
  return 100.0 + 2.0 * x - 3.0 * y + 0.05 * x * x - 0.08 * x * y + 0.03 * y * y;
}

// A block of samples from `corner`: those of every second row and column (one filter phase) and the
// mean monomials and value over all, counted from the corner.
struct Block {
  RowSum own;
  Monomials all = Monomials::Zero();
  double mean = 0;
};
template <class Value>
Block block(const Eigen::Vector2i& corner, int width, int height, const Value& value) {
  Block b;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const Eigen::Vector2i p(x, y);
      b.all += monomials_at(p);
      b.mean += value(corner + p);
      const Eigen::Vector2i frame = corner + p;
      if (frame.x() % 2 == 0 && frame.y() % 2 == 0) {
        b.own.add(monomials_at(p), value(frame), 4.0);
      }
    }
  }
  b.mean /= b.all[0];
  b.all /= b.all[0];
  return b;
}

TEST(RowMean, MonomialsMoveWithTheirOrigin) {
  const Eigen::Vector2i by(40, -23);
  const Eigen::Vector2i p(3, 7);
  const Eigen::Vector2i q(-5, 2);
  const Monomials moved_mean = moved(0.5 * (monomials_at(p) + monomials_at(q)), by);
  const Monomials mean_moved = 0.5 * (monomials_at(p + by) + monomials_at(q + by));
  EXPECT_LT((moved_mean - mean_moved).norm(), 1e-12);
}

// Exact for a cubic with the row's own samples, where they are enough.
TEST(RowMean, CubicFromItsOwnSamples) {
  const Block b = block({101, 50}, 19, 17, cubic);
  const RowFit fit(b.own);
  EXPECT_TRUE(fit.suffices());
  const RowMean mean = fit.mean_over(b.all);
  EXPECT_GT(std::abs(b.own.mean() - b.mean), 0.5);  // the plain mean is far off
  EXPECT_NEAR(mean.value, b.mean, 1e-8);
  EXPECT_GT(mean.spread, 1.0);
  EXPECT_NEAR(mean.variance, mean.spread * 4.0 / b.own.n(), 1e-12);
}

// Four own samples and those of the rows around.
TEST(RowMean, CubicFromNeighbours) {
  const Eigen::Vector2i corner(101, 50);
  const Block b = block(corner, 4, 4, cubic);
  ASSERT_EQ(b.own.n(), 4.0);
  RowFit fit(b.own);
  EXPECT_FALSE(fit.suffices());
  std::vector<Block> around;
  for (int y = -4; y <= 4; y += 4) {
    for (int x = -4; x <= 4; x += 4) {
      if (x == 0 && y == 0) continue;
      // Uneven sizes: lattices that are not the row's own.
      around.push_back(block(corner + Eigen::Vector2i(x, y), 4 + (x + y) / 4, 5, cubic));
      fit.add_neighbour(around.back().own, {x, y});
    }
  }
  const RowMean mean = fit.mean_over(b.all);
  EXPECT_NEAR(mean.value, b.mean, 1e-9);
  EXPECT_LT(mean.spread, 1.5);
}

// Seven samples give a plane, with those of one neighbour a quadratic.
TEST(RowMean, LowerDegreesWhereSamplesAreFew) {
  const auto plane = [](const Eigen::Vector2i& p) { return 5.0 + 2.0 * p.x() - 3.0 * p.y(); };
  const Block few = block({101, 50}, 5, 5, plane);
  ASSERT_LT(few.own.n(), 9.0);
  EXPECT_NEAR(RowFit(few.own).mean_over(few.all).value, few.mean, 1e-9);
  const Block b = block({101, 50}, 5, 5, quadratic);
  RowFit fit(b.own);
  const Block beside = block({106, 50}, 4, 5, quadratic);
  fit.add_neighbour(beside.own, {5, 0});
  ASSERT_LT(b.own.n() + beside.own.n(), 15.0);
  EXPECT_NEAR(fit.mean_over(b.all).value, b.mean, 1e-9);
}

// One line of samples tells no slope across it, and none is made up.
TEST(RowMean, PlainWhereTheSamplesTellNoMore) {
  RowSum line;
  for (int x = 0; x < 12; ++x) line.add(monomials_at({x, 0}), quadratic({x, 0}), 1.0);
  Monomials beside = line.mean_monomials();
  beside = moved(beside, {0, 1});
  const RowMean mean = RowFit(line).mean_over(beside);
  EXPECT_EQ(mean.value, line.mean());
  EXPECT_EQ(mean.spread, 1.0);
}

// The stated variance is that of the value: drawn samples, own and neighbours.
TEST(RowMean, VarianceHolds) {
  std::mt19937 random(5);
  std::normal_distribution<double> noise(0.0, 2.0);
  double squares = 0;
  double stated = 0;
  constexpr int kDraws = 4000;
  for (int i = 0; i < kDraws; ++i) {
    const auto noisy = [&](const Eigen::Vector2i&) { return noise(random); };
    const Block b = block({101, 50}, 5, 5, noisy);
    const Block beside = block({106, 50}, 5, 5, noisy);
    const Block below = block({101, 55}, 5, 5, noisy);
    RowFit fit(b.own);
    fit.add_neighbour(beside.own, {5, 0});
    fit.add_neighbour(below.own, {0, 5});
    const RowMean mean = fit.mean_over(b.all);
    squares += mean.value * mean.value / kDraws;
    stated += mean.variance / kDraws;
  }
  // Relative deviation of a variance from 4000 draws: 2.2 %. The statement is an upper bound, near
  // where neighbours say little.
  EXPECT_LT(squares / stated, 1.09);
  EXPECT_GT(squares / stated, 0.75);
}

}  // namespace
}  // namespace scattermeter
