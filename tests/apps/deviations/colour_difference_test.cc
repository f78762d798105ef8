#include "apps/deviations/colour_difference.h"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

namespace scattermeter::apps {
namespace {

struct LabPair {
  Eigen::Vector3d lab1, lab2;
  double difference;
};

// Pairs of table 1 of Sharma, Wu and Dalal (2005), chosen there to reach every branch.
TEST(ColourDifference, MeetsThePublishedPairs) {
  const std::array<LabPair, 15> pairs = {{
      {{50, 2.6772, -79.7751}, {50, 0, -82.7485}, 2.0425},
      {{50, 3.1571, -77.2803}, {50, 0, -82.7485}, 2.8615},
      {{50, 2.8361, -74.0200}, {50, 0, -82.7485}, 3.4412},
      {{50, -1.3802, -84.2814}, {50, 0, -82.7485}, 1.0000},
      {{50, 0, 0}, {50, -1, 2}, 2.3669},
      {{50, 2.4900, -0.0010}, {50, -2.4900, 0.0009}, 7.1792},
      {{50, 2.4900, -0.0010}, {50, -2.4900, 0.0011}, 7.2195},
      {{50, -0.0010, 2.4900}, {50, 0.0009, -2.4900}, 4.8045},
      {{50, 2.5, 0}, {73, 25, -18}, 27.1492},
      {{50, 2.5, 0}, {58, 24, 15}, 19.4535},
      {{50, 2.5, 0}, {50, 3.1736, 0.5854}, 1.0000},
      {{60.2574, -34.0099, 36.2677}, {60.4626, -34.1751, 39.4387}, 1.2644},
      {{6.7747, -0.2908, -2.4247}, {5.8714, -0.0985, -2.2286}, 0.6377},
      {{2.0776, 0.0795, -1.1350}, {0.9033, -0.0636, -0.5514}, 0.9082},
      {{50, 2.5, 0}, {50, 2.5, 0}, 0.0},
  }};
  for (const LabPair& p : pairs) {
    EXPECT_NEAR(ciede2000(p.lab1, p.lab2), p.difference, 5e-5) << p.lab1.transpose();
    EXPECT_NEAR(ciede2000(p.lab2, p.lab1), p.difference, 5e-5) << p.lab1.transpose();
  }
}

TEST(ColourDifference, LabOfKnownColours) {
  EXPECT_LT((lab_from_linear_srgb({1, 1, 1}) - Eigen::Vector3d(100, 0, 0)).norm(), 1e-9);
  EXPECT_LT(lab_from_linear_srgb({0, -1, 0}).norm(), 1e-9);
  // A grey of 18 % has L* = 116 * 0.18^(1/3) - 16.
  EXPECT_NEAR(lab_from_linear_srgb({0.18, 0.18, 0.18})[0], 116.0 * std::cbrt(0.18) - 16.0, 1e-9);
  // The red primary, as tabulated for D65.
  EXPECT_LT((lab_from_linear_srgb({1, 0, 0}) - Eigen::Vector3d(53.24, 80.09, 67.20)).norm(), 0.05);
}

}  // namespace
}  // namespace scattermeter::apps
