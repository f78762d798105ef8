#include "core/material/phase_effect.h"

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "tests/fixtures/core/escape_rings.h"

namespace scattermeter {
namespace {

// Power that leaves within a radius, by the curve; midpoint rule in the radius.
double within(const Medium& medium, double radius_mm, double structure_mm = 0.0) {
  constexpr int kSteps = 20'000;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double r = (i + 0.5) * radius_mm / kSteps;
    sum += 2.0 * std::numbers::pi * r * phase_effect_per_mm2(medium, r, structure_mm);
  }
  return sum * radius_mm / kSteps;
}

// The tracer in a box that light does not cross. Rings end at eighths to fours of a mean free path.
TEST(PhaseEffect, IsThatOfPaths) {
  const std::vector<double> edges_mm = {0.125, 0.25, 0.5, 1.0, 2.0, 4.0};
  for (const Medium& medium :
       {Medium{0.997, 0.003, 1.3}, Medium{0.997, 0.003, 1.5}, Medium{0.91, 0.09, 1.3}}) {
    const PhaseFunction forward = 0.6;
    constexpr int kBlocks = 100, kPaths = 2000;
    const Eigen::Vector3d size_mm(200, 200, 100);
    const auto even =
        test_support::pencil(size_mm, scattering_medium(medium), edges_mm, kBlocks, kPaths);
    const auto ahead = test_support::pencil(size_mm, scattering_medium(medium, forward), edges_mm,
                                            kBlocks, kPaths);
    double of_paths = 0.0;
    for (std::size_t i = 0; i < edges_mm.size(); ++i) {
      of_paths += ahead.power[i].mean() - even.power[i].mean();
      EXPECT_NEAR(within(medium, edges_mm[i]) * (forward.gamma() - 1.0), of_paths, 0.006)
          << medium.eta_int_over_ext << ", " << edges_mm[i];
    }
  }
}

// With a reach of l'/6, half of the light is within that radius.
TEST(PhaseEffect, NearEntryIsAKernel) {
  const Medium medium{2.0, 0.0, 1.4};
  double sum = 0.0, half = 0.0;
  constexpr double kStep = 1e-3;
  for (double r = 0.5 * kStep; r < 20.0; r += kStep) {
    const double ring = 2.0 * std::numbers::pi * r * near_entry_per_mm2(medium, r) * kStep;
    sum += ring;
    if (r < 0.0825) half += ring;
  }
  EXPECT_NEAR(sum, 1.0, 1e-3);
  EXPECT_NEAR(half, 0.5, 2e-2);
  EXPECT_GT(phase_turn(1.3), phase_turn(1.5));
}

TEST(PhaseEffect, KeepsItsIntegralWithoutFineStructure) {
  const Medium medium{2.0, 0.01, 1.4};
  EXPECT_NEAR(within(medium, 12.0), within(medium, 12.0, 0.3), 2e-3);
  // Lengths scale with the mean free path.
  const Medium twice{4.0, 0.02, 1.4};
  EXPECT_NEAR(phase_effect_per_mm2(twice, 0.4), 4.0 * phase_effect_per_mm2(medium, 0.8), 1e-12);
}

}  // namespace
}  // namespace scattermeter
