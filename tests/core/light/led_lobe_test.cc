#include "core/light/led_lobe.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/light/led.h"

namespace scattermeter {
namespace {

using ::testing::HasSubstr;

constexpr double kDegree_rad = std::numbers::pi / 180.0;
const Eigen::Vector3d kDown = -Eigen::Vector3d::UnitZ();

std::vector<double> degrees(double first, double last, double step) {
  std::vector<double> out;
  for (int i = 0; first + i * step <= last + 1e-9; ++i) {
    out.push_back((first + i * step) * kDegree_rad);
  }
  return out;
}
std::vector<double> cosine_power(const std::vector<double>& angles_rad, double exponent) {
  std::vector<double> out;
  for (double a : angles_rad) {
    out.push_back(std::pow(std::max(0.0, std::cos(a)), exponent));
    if (out.back() < 1e-12) out.back() = 0.0;
  }
  return out;
}
// Below the LED, `angle` from its axis and `azimuth` from x.
Eigen::Vector3d towards(double angle_deg, double azimuth_deg) {
  const double a = angle_deg * kDegree_rad;
  const double p = azimuth_deg * kDegree_rad;
  return {std::sin(a) * std::cos(p), std::sin(a) * std::sin(p), -std::cos(a)};
}

// A table of every five degrees, as data sheets have, against the power that it tabulates.
TEST(LobeTable, TabulatedPowerIsThatPower) {
  const std::vector<double> angles = degrees(0, 90, 5);
  for (double exponent : {1.0, 2.0, 3.0, 20.0}) {
    Led power;
    power.exponent = exponent;
    const LobeTable table(angles, cosine_power(angles, exponent));
    double worst = 0.0;
    for (double a = 0.1; a < 90.0; a += 0.7) {
      const Eigen::Vector3d w = towards(a, 7.0 * a);
      worst = std::max(worst, std::abs(table.value<double>(kDown, w) - power.lobe(w)));
    }
    EXPECT_LT(worst, exponent < 5.0 ? 1e-3 : 6e-3) << exponent;
    EXPECT_EQ(table.value<double>(kDown, kDown), 1.0);
    EXPECT_EQ(table.value<double>(kDown, -kDown), 0.0);
    EXPECT_EQ(table.value<double>(kDown, Eigen::Vector3d::UnitX()), 0.0);
  }
}

TEST(LobeTable, NeitherOvershootsNorHasKinks) {
  const LobeTable table({0.0, 20 * kDegree_rad, 30 * kDegree_rad, 50 * kDegree_rad},
                        {0.8, 1.0, 1.0, 0.0});
  double before = table.value<double>(kDown, towards(0.0, 0.0));
  double slope_before = 0.0;
  for (double a = 0.05; a < 50.0; a += 0.05) {
    const double v = table.value<double>(kDown, towards(a, 30.0));
    EXPECT_GE(v, 0.0);
    EXPECT_LE(v, 1.0 + 1e-12);
    const double slope = (v - before) / 0.05;
    EXPECT_LT(std::abs(slope - slope_before), 0.002) << a;
    before = v;
    slope_before = slope;
  }
  EXPECT_EQ(table.value<double>(kDown, towards(51.0, 0.0)), 0.0);
}

// An elliptical lobe, and one that is not the same on both sides.
TEST(LobeTable, TwoPlanes) {
  const std::vector<double> angles = degrees(0, 90, 5);
  const LobeTable ellipse(angles, cosine_power(angles, 1.0), cosine_power(angles, 4.0),
                          {2.0, 0.0, 7.0});
  EXPECT_NEAR(ellipse.value<double>(kDown, towards(60, 0)), 0.5, 1e-12);
  EXPECT_NEAR(ellipse.value<double>(kDown, towards(60, 180)), 0.5, 1e-12);
  EXPECT_NEAR(ellipse.value<double>(kDown, towards(60, 90)), 0.0625, 1e-12);
  EXPECT_NEAR(ellipse.value<double>(kDown, towards(60, 30)), 0.75 * 0.5 + 0.25 * 0.0625, 1e-12);

  const double a = 60 * kDegree_rad;
  const LobeTable skew({-a, 0.0, a}, {0.0, 1.0, 0.0}, {0.0, 1.0, 0.0}, Eigen::Vector3d::UnitX());
  const LobeTable sides({-90 * kDegree_rad, -a, 0.0, a, 90 * kDegree_rad}, {0, 0.1, 1.0, 0.4, 0},
                        {0, 0.2, 1.0, 0.3, 0}, Eigen::Vector3d::UnitX());
  EXPECT_NEAR(sides.value<double>(kDown, towards(60, 0)), 0.4, 1e-12);
  EXPECT_NEAR(sides.value<double>(kDown, towards(60, 180)), 0.1, 1e-12);
  // axis x x_axis is -z x x = -y.
  EXPECT_NEAR(sides.value<double>(kDown, towards(60, 270)), 0.3, 1e-12);
  EXPECT_NEAR(sides.value<double>(kDown, towards(60, 90)), 0.2, 1e-12);
  EXPECT_EQ(skew.value<double>(kDown, towards(61, 45)), 0.0);
}

// The planes follow the axis when the LED is tilted.
TEST(LobeTable, TurnsWithTheAxis) {
  const std::vector<double> angles = degrees(0, 90, 10);
  const LobeTable table(angles, cosine_power(angles, 1.0), cosine_power(angles, 4.0),
                        Eigen::Vector3d::UnitX());
  const double s = std::sqrt(0.5);
  const Eigen::Vector3d axis(0, s, -s);
  EXPECT_NEAR(table.value<double>(axis, 0.5 * axis + std::sqrt(0.75) * Eigen::Vector3d::UnitX()),
              0.5, 1e-12);
}

TEST(LobeTable, CorrectedByAPower) {
  const std::vector<double> angles = degrees(0, 90, 5);
  Led led;
  led.table = std::make_shared<LobeTable>(angles, cosine_power(angles, 1.0));
  led.exponent = 2.0;
  EXPECT_NEAR(led.lobe(towards(60, 10)), 0.125, 1e-12);
}

TEST(LobeTable, HasPlanesAboutAnAxisAcrossItsOwn) {
  const LobeTable planes({0.0, 1.5}, {1.0, 0.0}, {1.0, 0.0}, 3.0 * Eigen::Vector3d::UnitX());
  EXPECT_TRUE(planes.has_planes_about(Eigen::Vector3d(0.9, 0.0, -0.5).normalized()));
  EXPECT_FALSE(planes.has_planes_about(Eigen::Vector3d(-1.0, 0.05, 0.0).normalized()));
  const LobeTable round({0.0, 1.5}, {1.0, 0.0});
  EXPECT_TRUE(round.has_planes_about(Eigen::Vector3d::UnitX()));
}

TEST(LobeTable, RefusesWhatIsNoLobe) {
  const auto refusal = [](std::vector<double> angles_deg, std::vector<double> x,
                          std::vector<double> y = {}) -> std::string {
    for (double& a : angles_deg) a *= kDegree_rad;
    try {
      LobeTable(angles_deg, x, y);
    } catch (const std::invalid_argument& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_EQ(refusal({0, 90}, {1, 0.5}), "");
  EXPECT_THAT(refusal({0}, {1}), HasSubstr("at least two angles"));
  EXPECT_THAT(refusal({0, 20, 20}, {1, 1, 0}), HasSubstr("increase"));
  EXPECT_THAT(refusal({0, 95}, {1, 0}), HasSubstr("at most 90"));
  EXPECT_THAT(refusal({5, 90}, {1, 0}), HasSubstr("the angle 0"));
  EXPECT_THAT(refusal({-90, 0, 90}, {0, 1, 0}), HasSubstr("two planes"));
  EXPECT_THAT(refusal({0, 60}, {1, 0.5}), HasSubstr("up to 90 degrees"));
  EXPECT_THAT(refusal({-60, 0, 90}, {0.5, 1, 0}, {0, 1, 0}), HasSubstr("up to 90 degrees"));
  EXPECT_THAT(refusal({0, 90}, {1, -1}), HasSubstr("at least 0"));
  EXPECT_THAT(refusal({0, 90}, {0, 0}), HasSubstr("above 0"));
  EXPECT_THAT(refusal({0, 90}, {1, 0, 0}), HasSubstr("as many"));
  EXPECT_THAT(refusal({0, 90}, {1, 0}, {0.9, 0}), HasSubstr("same intensity"));
}

}  // namespace
}  // namespace scattermeter
