#include "core/transport/absorption_tilts.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include <gtest/gtest.h>

namespace scattermeter {
namespace {

constexpr double kSize_mm = 20.0;

double fading_per_mm(double sigma_s) {
  return std::numbers::pi * std::numbers::pi / (kSize_mm * kSize_mm * sigma_s);
}

TEST(AbsorptionTilts, AddsTheExponentials) {
  const AbsorptionTilts tilts(1.3, kSize_mm);
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(tilts.count());
  tilts.add(2.0, 0.7, sums.data());
  tilts.add(0.5, 30.0, sums.data());
  for (Eigen::Index j = 0; j < tilts.count(); ++j) {
    const double a = tilts.per_mm()[j];
    EXPECT_NEAR(sums[j], 2.0 * std::exp(-0.7 * a) + 0.5 * std::exp(-30.0 * a), 1e-12);
  }
  EXPECT_EQ(tilts.per_mm()[0], 0.0);
  EXPECT_GE(tilts.per_mm()[tilts.count() - 1], 2.0 * 1.3);
}

TEST(AbsorptionTilts, MeetTheExponentialOfAnyLength) {
  for (const double sigma_s : {0.2, 1.0, 3.0, 10.0}) {
    const AbsorptionTilts tilts(sigma_s, kSize_mm);
    for (const double share : {0.0, 1e-4, 1e-3, 0.01, 0.1, 0.5, 1.0}) {
      const AbsorptionTilts::Combination c = tilts.at(share * sigma_s);
      for (double length = 0.01; length < 2e4; length *= 1.3) {
        const double fading = std::exp(-0.5 * fading_per_mm(sigma_s) * length);
        const double met = c.l.dot((-tilts.per_mm() * length).array().exp().matrix());
        EXPECT_NEAR(fading * met, fading * std::exp(-share * sigma_s * length), 1e-3)
            << sigma_s << " " << share << " " << length;
      }
    }
  }
}

// Paths whose number decreases as exp(-k L): the light is k / (k + sigma_a), and its change
// -k / (k + sigma_a)^2. With k from the fading of a body to that of light beside its entry.
TEST(AbsorptionTilts, MeetTheLightOfManyLengths) {
  constexpr double kSigmaS = 1.3;
  const AbsorptionTilts tilts(kSigmaS, kSize_mm);
  for (const double k : {fading_per_mm(kSigmaS), 0.1, 1.0}) {
    const Eigen::VectorXd light = k / (k + tilts.per_mm().array());
    for (const double sigma_a : {0.0, 0.0005, 0.004, 0.03, 0.3, 1.3}) {
      const AbsorptionTilts::Combination c = tilts.at(sigma_a);
      EXPECT_NEAR(c.l.dot(light) * (k + sigma_a) / k, 1.0, 5e-4) << k << " " << sigma_a;
      EXPECT_NEAR(-c.per_sigma_a.dot(light) * std::pow(k + sigma_a, 2) / k, 1.0, 0.02)
          << k << " " << sigma_a;
    }
  }
}

TEST(AbsorptionTilts, CoarserOnesUseEveryThird) {
  const AbsorptionTilts tilts(1.3, kSize_mm);
  const AbsorptionTilts::Combination c = tilts.at(0.02, 3);
  for (Eigen::Index j = 0; j < tilts.count(); ++j) {
    if (j % 3 != 0) {
      EXPECT_EQ(c.l[j], 0.0);
    }
  }
  const Eigen::VectorXd light = 0.1 / (0.1 + tilts.per_mm().array());
  EXPECT_NEAR(c.l.dot(light) * (0.1 + 0.02) / 0.1, 1.0, 0.03);
}

TEST(AbsorptionTilts, RefuseWhatIsNotPositive) {
  EXPECT_THROW(AbsorptionTilts(0.0, 20.0), std::invalid_argument);
  EXPECT_THROW(AbsorptionTilts(1.0, 0.0), std::invalid_argument);
}

}  // namespace
}  // namespace scattermeter
