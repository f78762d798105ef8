#include "core/base/random_stream.h"

#include <gtest/gtest.h>

#include "tests/fixtures/core/block_mean.h"

namespace scattermeter {
namespace {

// Published: the 10000th number of the generator seeded with 5489 (C++ standard, [rand.predef]).
TEST(RandomStream, IsTheMersenneTwister) {
  std::mt19937_64 generator;
  generator.discard(9999);
  EXPECT_EQ(generator(), 9981545732273789042ULL);
}

TEST(RandomStream, SeedAndStreamDecideTheNumbers) {
  RandomStream a(1, 2), same(1, 2), other_stream(1, 3), other_seed(2, 2), high(1, 2ULL << 32);
  const std::uint64_t first = a.bits();
  EXPECT_EQ(first, same.bits());
  EXPECT_NE(first, other_stream.bits());
  EXPECT_NE(first, other_seed.bits());
  EXPECT_NE(first, high.bits());
}

// Squared radius even over (0, 1), not correlated with the angle.
TEST(RandomStream, DiscIsEven) {
  RandomStream random(3, 0);
  test_support::BlockMean r2, r4, x, xr2;
  for (int i = 0; i < 100'000; ++i) {
    const RandomStream::DiscPoint p = random.disc();
    r2.add(p.r2);
    r4.add(p.r2 * p.r2);
    x.add(p.x);
    xr2.add(p.x * p.r2);
  }
  EXPECT_LT(std::abs(r2.z(0.5)), test_support::kSigmas);
  EXPECT_LT(std::abs(r4.z(1.0 / 3.0)), test_support::kSigmas);
  EXPECT_LT(std::abs(x.z(0.0)), test_support::kSigmas);
  EXPECT_LT(std::abs(xr2.z(0.0)), test_support::kSigmas);
}

}  // namespace
}  // namespace scattermeter
