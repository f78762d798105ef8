#include "core/light/lit_points.h"

#include <cmath>

#include <gtest/gtest.h>

namespace scattermeter {
namespace {

constexpr std::size_t kAnyNumber = 1'000'000;

// A right triangle, legs 3 mm and 4 mm, its hypotenuse the longest edge of 5 mm.
IncidentLight one_triangle(const std::array<double, 3>& irradiance) {
  IncidentLight light;
  light.lit.push_back({{Eigen::Vector3d{0, 0, 1}, {3, 0, 1}, {0, 4, 1}}, irradiance, 0});
  return light;
}

double sum_of(const LitPoints& lit, const auto& f) {
  double sum = 0.0;
  for (std::size_t k = 0; k < lit.points_mm.size(); ++k)
    sum += lit.power_sr[k] * f(lit.points_mm[k]);
  return sum;
}

// ∫ x^p y^q dA over the triangle: 3^(p+1) 4^(q+1) p! q! / (p + q + 2)!.
double moment(int p, int q) {
  return std::pow(3.0, p + 1) * std::pow(4.0, q + 1) * std::tgamma(p + 1) * std::tgamma(q + 1) /
         std::tgamma(p + q + 3);
}

// Edges over the scale of 0.5, 1, 2 and 5: three points, six, and six in each of 4 and 25 parts.
TEST(LitPoints, CountFollowsTheScale) {
  const IncidentLight light = one_triangle({1.0, 2.0, 3.0});
  for (const auto& [scale_mm, count] :
       {std::pair{10.0, 3U}, {5.0, 6U}, {2.5, 24U}, {1.0, 150U}, {0.9, 216U}}) {
    const auto lit = lit_points(light, scale_mm, kAnyNumber);
    ASSERT_TRUE(lit.has_value());
    EXPECT_EQ(lit->points_mm.size(), count) << scale_mm;
    EXPECT_EQ(lit->power_sr.size(), count) << scale_mm;
    for (std::size_t k = 0; k < count; ++k) {
      const Eigen::Vector3d& p = lit->points_mm[k];
      EXPECT_NEAR(p.z(), 1.0, 1e-15);
      EXPECT_TRUE(p.x() > 0.0 && p.y() > 0.0 && p.x() / 3.0 + p.y() / 4.0 < 1.0);
      EXPECT_GT(lit->power_sr[k], 0.0);
    }
  }
}

// An even irradiance of 2 times x^p y^q: exact up to degree 2, and 4 where there are six points.
TEST(LitPoints, ExactForPolynomials) {
  const IncidentLight light = one_triangle({2.0, 2.0, 2.0});
  for (const double scale_mm : {10.0, 5.0, 1.7}) {
    const auto lit = lit_points(light, scale_mm, kAnyNumber);
    for (int p = 0; p <= 4; ++p) {
      for (int q = 0; p + q <= (scale_mm > 5.0 ? 2 : 4); ++q) {
        const double sum = sum_of(*lit, [&](const Eigen::Vector3d& x) {
          return std::pow(x.x(), p) * std::pow(x.y(), q);
        });
        EXPECT_NEAR(sum, 2.0 * moment(p, q), 2e-13 * std::abs(sum)) << p << ' ' << q;
      }
    }
  }
}

// A linear irradiance 1 + x / 3 + 2 y / 4 counts as a degree.
TEST(LitPoints, CarryALinearIrradiance) {
  const IncidentLight light = one_triangle({1.0, 2.0, 3.0});
  for (const double scale_mm : {10.0, 5.0, 1.7}) {
    const auto lit = lit_points(light, scale_mm, kAnyNumber);
    EXPECT_NEAR(sum_of(*lit, [](const Eigen::Vector3d&) { return 1.0; }), power_sr(light.lit[0]),
                1e-13);
    const double truth = moment(1, 0) + moment(2, 0) / 3.0 + moment(1, 1) / 2.0;
    EXPECT_NEAR(sum_of(*lit, [](const Eigen::Vector3d& x) { return x.x(); }), truth, 1e-12);
  }
}

TEST(LitPoints, EmptyWhereThereWouldBeTooMany) {
  const IncidentLight light = one_triangle({1.0, 1.0, 1.0});
  EXPECT_TRUE(lit_points(light, 1.0, 150).has_value());
  EXPECT_FALSE(lit_points(light, 1.0, 149).has_value());
  EXPECT_FALSE(lit_points(light, 1e-200, kAnyNumber).has_value());
  EXPECT_TRUE(lit_points({}, 1.0, 0)->points_mm.empty());
}

}  // namespace
}  // namespace scattermeter
