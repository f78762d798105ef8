#include "core/material/eta_change.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/material/fresnel.h"

namespace scattermeter {
namespace {

// At normal incidence T = 4 eta / (eta + 1)^2, from either side.
TEST(EtaChange, NormalIncidence) {
  constexpr double kIndex = 1.45;
  const auto t = [](double eta) { return 4.0 * eta / ((eta + 1.0) * (eta + 1.0)); };
  const double passed = (t(kIndex + kEtaStep) / t(kIndex) - 1.0) / kEtaStep;
  const double reflected = ((1.0 - t(kIndex + kEtaStep)) / (1.0 - t(kIndex)) - 1.0) / kEtaStep;
  for (const bool from_outside : {true, false}) {
    EXPECT_NEAR(fresnel_growth(kIndex, from_outside, 1.0, true), passed, 1e-10);
    EXPECT_NEAR(fresnel_growth(kIndex, from_outside, 1.0, false), reflected, 1e-10);
  }
  EXPECT_NEAR(observed_growth(kIndex, 1.0), -passed / (1.0 + kEtaStep * passed), 1e-10);
}

// What is totally reflected stays so; what meets the boundary just within the critical angle no
// longer passes.
TEST(EtaChange, TotalReflection) {
  constexpr double kIndex = 1.45;
  const auto critical = [](double eta) { return std::sqrt(1.0 - 1.0 / (eta * eta)); };
  EXPECT_EQ(fresnel_growth(kIndex, false, 0.9 * critical(kIndex), false), 0.0);
  const double between = 0.5 * (critical(kIndex) + critical(kIndex + kEtaStep));
  EXPECT_EQ(fresnel_growth(kIndex, false, between, true), -1.0 / kEtaStep);
}

// From inside, the mean over diffuse light of what single directions gain and lose, by quadrature;
// from outside as at a smooth boundary.
TEST(EtaChange, RoughGrowthIsTheMeanOverDirections) {
  for (const double eta : {1.3, 1.45, 1.55}) {
    constexpr int kSteps = 200000;
    double reflected = 0.0, change = 0.0;
    for (int i = 0; i < kSteps; ++i) {
      const double cos2 = (i + 0.5) / kSteps;  // evenly in diffuse light
      const double r = 1.0 - fresnel_transmittance(1.0 / eta, std::sqrt(cos2));
      reflected += r / kSteps;
      change += r * fresnel_growth(eta, false, std::sqrt(cos2), false) / kSteps;
    }
    EXPECT_NEAR(rough_growth(eta, -0.7, false), change / reflected, 0.04 * change / reflected)
        << eta;
    EXPECT_EQ(rough_growth(eta, 0.7, true), fresnel_growth(eta, true, 0.7, true));
    EXPECT_NEAR(rough_growth(eta, -0.7, true), -change / (1.0 - reflected), 0.06 * change) << eta;
  }
}

// Of sigma_t / mu exp(-sigma_t z / mu), with Snell's mu, by differences; its integral over the
// depth does not change.
TEST(EtaChange, DepthGrowth) {
  constexpr double kIndex = 1.4, kSinOutside = 0.7, kSigmaT = 1.2;
  const auto mu = [&](double eta) { return std::sqrt(1.0 - std::pow(kSinOutside / eta, 2)); };
  const auto log_density = [&](double z, double eta) {
    return std::log(kSigmaT / mu(eta)) - kSigmaT * z / mu(eta);
  };
  constexpr double kStep = 1e-5;
  for (const double z : {0.1, 0.8, 3.0}) {
    const double expected =
        (log_density(z, kIndex + kStep) - log_density(z, kIndex - kStep)) / (2.0 * kStep);
    EXPECT_NEAR(depth_growth(kIndex, mu(kIndex), kSigmaT * z / mu(kIndex)), expected, 1e-6);
  }
  EXPECT_EQ(depth_growth(kIndex, 0.8, 1.0), 0.0);
}

// What passes; a direction that no refracted ray has tells nothing.
TEST(EtaChange, EntryGrowth) {
  constexpr double kIndex = 1.4, kCosOutside = 0.6;
  const double cos_inside = std::sqrt(1.0 - (1.0 - kCosOutside * kCosOutside) / (kIndex * kIndex));
  EXPECT_NEAR(entry_growth(kIndex, cos_inside), fresnel_growth(kIndex, true, kCosOutside, true),
              1e-9);
  EXPECT_EQ(entry_growth(kIndex, 0.5), 0.0);
  EXPECT_EQ(entry_growth(kIndex, 0.0), 0.0);  // a beam starts inside
}

// Of diffuse light inside, what leaves changes by as much whether directions outside are held, or
// those inside.
TEST(EtaChange, ExitGrowthIsThatOfDirectionsInside) {
  for (const double eta : {1.3, 1.45, 1.55}) {
    constexpr int kSteps = 200000;
    double by_inside = 0.0, by_outside = 0.0;
    for (int i = 0; i < kSteps; ++i) {
      const double cosine = std::sqrt((i + 0.5) / kSteps);  // evenly in diffuse light
      by_inside += fresnel_transmittance(1.0 / eta, cosine) *
                   fresnel_growth(eta, false, cosine, true) / kSteps;
      const double t = fresnel_transmittance(eta, cosine) / (eta * eta);
      // A flight as long as the mean: what is scattered last does not change.
      by_outside +=
          t * (fresnel_growth(eta, true, cosine, true) + exit_growth(eta, 0.9, 1.0)) / kSteps;
    }
    EXPECT_NEAR(by_outside, by_inside, 0.03 * std::abs(by_inside)) << eta;
  }
}

}  // namespace
}  // namespace scattermeter
