#include "core/light/rough_entry.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/material/rough_boundary.h"
#include "tests/fixtures/core/block_mean.h"

namespace scattermeter {
namespace {

// Light of power 2 that arrives at one angle on a plane z = 0.
class Arriving : public EntrySource {
 public:
  std::optional<Entry> sample(double stratum, RandomStream&) const override {
    return Entry{{stratum, 0, 0}, {0.8, 0, -0.6}, 2.0, Eigen::Vector3d::UnitZ()};
  }
};

// What gets in is the boundary's share of it, in directions below the surface, mostly refracted.
TEST(RoughEntry, LetsInWhatTheBoundaryPasses) {
  constexpr double kRoughEta = 1.5;
  const auto source = rough_entry(std::make_unique<Arriving>(), 0.2, kRoughEta);
  RandomStream random(1, 0);
  test_support::BlockMean power, along;
  for (int block = 0; block < 50; ++block) {
    double sum = 0.0, sum_along = 0.0;
    for (int i = 0; i < 2000; ++i) {
      const auto entry = source->sample(0.25, random);
      if (!entry) continue;
      EXPECT_LT(entry->direction.z(), 0.0);
      EXPECT_NEAR(entry->direction.norm(), 1.0, 1e-12);
      EXPECT_EQ(entry->position_mm.x(), 0.25);
      sum += entry->power / 2000.0;
      sum_along += entry->power * entry->direction.x() / 2000.0;
    }
    power.add(sum);
    along.add(sum_along / sum);
  }
  EXPECT_NEAR(power.mean(), 2.0 * RoughBoundary(0.2, kRoughEta).transmittance(0.6), 0.01);
  EXPECT_NEAR(along.mean(), 0.8 / kRoughEta, 0.05);
}

}  // namespace
}  // namespace scattermeter
