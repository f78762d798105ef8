#include "core/nuisances/halo.h"

#include <cmath>

#include <gtest/gtest.h>

namespace scattermeter {
namespace {

// Share of a normal distribution about x between two points.
double between(double x, double low, double high, double std) {
  return 0.5 * (std::erf((high - x) / (std * M_SQRT2)) - std::erf((low - x) / (std * M_SQRT2)));
}

// Of an evenly bright rectangle: in closed form.
TEST(Halo, OfARectangle) {
  constexpr double kWidth = 120.0, kHeight = 80.0, kCounts = 1000.0;
  constexpr double kStd = 0.25 * kWidth;
  std::vector<Eigen::Vector2d> at_px;
  for (double y = 0.0; y <= kHeight; y += 2.0) {
    for (double x = 0.0; x <= kWidth; x += 2.0) at_px.emplace_back(300.0 + x, 200.0 + y);
  }
  const auto n = static_cast<Eigen::Index>(at_px.size());
  const Halo h = halo(at_px, Eigen::VectorXd::Constant(n, kCounts));
  const auto expected = [&](double x, double y) {
    return kCounts * between(x, 300.0, 300.0 + kWidth, kStd) *
           between(y, 200.0, 200.0 + kHeight, kStd);
  };
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Vector2d& at = at_px[static_cast<std::size_t>(i)];
    EXPECT_NEAR(h.counts[i], expected(at.x(), at.y()), 0.01 * kCounts) << at.transpose();
  }
  EXPECT_NEAR(h.counts[n / 2], expected(360.0, 240.0), 0.01 * kCounts);
  // Half a cell outside: less than at the middle of an edge, more than at a corner.
  EXPECT_LT(h.beside_counts, expected(296.0, 240.0));
  EXPECT_GT(h.beside_counts, expected(296.0, 196.0));
}

// Light on one side reaches the dark one.
TEST(Halo, ReachesTheDarkSide) {
  std::vector<Eigen::Vector2d> at_px;
  for (int i = 0; i < 100; ++i) {
    for (int j = 0; j < 100; ++j) at_px.emplace_back(i, j);
  }
  Eigen::VectorXd counts(10000);
  for (Eigen::Index i = 0; i < counts.size(); ++i)
    counts[i] = at_px[static_cast<std::size_t>(i)].x() < 50 ? 100.0 : 0.0;
  const Halo h = halo(at_px, counts);
  const double near = h.counts[60 * 100 + 50], far = h.counts[99 * 100 + 50];
  EXPECT_NEAR(near, 100.0 * between(60.0, 0.0, 50.0, 25.0) * between(50.0, 0.0, 100.0, 25.0), 2.0);
  EXPECT_LT(far, 0.2 * near);
}

TEST(Halo, NothingWithoutExtent) {
  EXPECT_EQ(halo({}, Eigen::VectorXd()).beside_counts, 0.0);
  EXPECT_EQ(halo({{3.0, 4.0}}, Eigen::VectorXd::Ones(1)).counts[0], 0.0);
}

}  // namespace
}  // namespace scattermeter
