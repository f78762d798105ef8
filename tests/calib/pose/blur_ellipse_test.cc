#include "calib/pose/blur_ellipse.h"

#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

namespace scattermeter::calib {
namespace {

// Edges in these directions (degrees) of a picture blurred by `along` px in x and `across` in y.
std::vector<EdgeBlur> edges(const std::vector<double>& degrees, double along, double across) {
  std::vector<EdgeBlur> out;
  for (const double d : degrees) {
    const double a = d * std::numbers::pi / 180.0;
    const Eigen::Vector2d n(std::cos(a), std::sin(a));
    out.push_back({n, std::hypot(along * n.x(), across * n.y())});
  }
  return out;
}

const std::vector<double> kPolygon = {0,   10, 20, 60, 65, 70, 75, 90, 95, 100, 120, 125,
                                      130, 0,  10, 20, 60, 65, 70, 75, 90, 95,  100, 120};

TEST(BlurEllipse, OfOneBlurInAllDirections) {
  EXPECT_NEAR(widest_blur_px(edges(kPolygon, 0.8, 0.8)), 0.8, 1e-9);
  EXPECT_EQ(widest_blur_px({}), 0.0);
}

// A motion in x leaves edges along it sharp: the median of these edges tells a third of it.
TEST(BlurEllipse, OfAMotion) {
  EXPECT_GT(widest_blur_px(edges(kPolygon, 1.2, 0.2)), 1.0);
  EXPECT_LT(widest_blur_px(edges(kPolygon, 1.2, 0.2)), 1.25);
}

// Edges of one direction tell nothing of the other.
TEST(BlurEllipse, OfOneDirection) {
  const double found = widest_blur_px(edges({90, 90, 90, 90, 90, 90, 90, 90}, 2.0, 0.5));
  EXPECT_GT(found, 0.49);
  EXPECT_LT(found, 0.6);
}

TEST(BlurEllipse, AFewWrongEdgesChangeLittle) {
  std::vector<EdgeBlur> all = edges(kPolygon, 0.5, 0.5);
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0.0, 0.05);
  for (EdgeBlur& e : all) e.blur_px += noise(random);
  for (const std::size_t i : {2U, 9U, 17U, 20U}) all[i].blur_px = 5.0;
  EXPECT_NEAR(widest_blur_px(all), 0.5, 0.12);
}

}  // namespace
}  // namespace scattermeter::calib
