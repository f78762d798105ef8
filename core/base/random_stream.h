// A stream of random numbers for one block of paths.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>

#include <Eigen/Core>

namespace scattermeter {

// The 64-bit Mersenne twister (Nishimura 2000), seeded through std::seed_seq from a seed and the
// number of a stream: the same pair gives the same numbers on every platform.
class RandomStream {
 public:
  RandomStream(std::uint64_t seed, std::uint64_t stream) : generator_(words(seed, stream)) {}

  std::uint64_t bits() { return generator_(); }
  // In (0, 1), neither end; 53 bits.
  double uniform() { return (static_cast<double>(bits() >> 11) + 0.5) * 0x1p-53; }
  // Uniform over the unit disc without its centre. The squared radius is uniform over (0, 1) and
  // independent of the angle, so one point provides both.
  struct DiscPoint {
    double x, y, r2;
  };
  DiscPoint disc() {
    for (;;) {
      const std::uint64_t b = bits();
      const double x = (static_cast<double>(static_cast<std::int32_t>(b)) + 0.5) * 0x1p-31;
      const double y = (static_cast<double>(static_cast<std::int32_t>(b >> 32)) + 0.5) * 0x1p-31;
      const double r2 = x * x + y * y;
      if (r2 < 1.0) return {x, y, r2};
    }
  }

 private:
  static std::mt19937_64 words(std::uint64_t seed, std::uint64_t stream) {
    std::seed_seq words{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32),
                        static_cast<std::uint32_t>(stream),
                        static_cast<std::uint32_t>(stream >> 32)};
    return std::mt19937_64(words);
  }
  std::mt19937_64 generator_;
};

}  // namespace scattermeter
