#include "capture/shots/pedestal.h"

#include <array>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace scattermeter::capture {
namespace {

constexpr PixelRect kBright{100, 80, 100, 80};

// Noise about black + level(x), and an object of 2000 counts more.
template <class Level>
RawFrame frame_over(const Level& level_counts) {
  RawFrame f;
  f.width_px = 320;
  f.height_px = 240;
  f.black_counts = {64, 64, 64, 64};
  f.white_counts = 4095;
  std::mt19937_64 random(3);
  std::normal_distribution<double> noise(0.0, 1.5);
  for (int y = 0; y < f.height_px; ++y) {
    for (int x = 0; x < f.width_px; ++x) {
      const bool object = x >= kBright.x0 && x < kBright.x0 + kBright.width && y >= kBright.y0 &&
                          y < kBright.y0 + kBright.height;
      f.samples.push_back(static_cast<std::uint16_t>(
          std::lround(64.0 + level_counts(x) + (object ? 2000.0 : noise(random)))));
    }
  }
  return f;
}

TEST(Pedestal, IsSeenInADarkBackground) {
  for (const double level : {0.0, 6.0, 20.0}) {
    const Pedestal p = pedestal_of(frame_over([&](int) { return level; }), kBright);
    for (std::size_t c = 0; c < kRgb; ++c) {
      EXPECT_NEAR(p.counts[c], 0.5 * level, 0.05);
      // All and none of the level are a little more than one deviation off.
      EXPECT_NEAR(p.std_counts[c], std::hypot(0.4 * level, 0.1, 2e-3 * 104.0), 0.1 + 0.03 * level);
    }
  }
}

// A background cannot be darker than black: what is below is an error of the black level.
TEST(Pedestal, BelowBlackIsCertain) {
  const Pedestal p = pedestal_of(frame_over([](int) { return -5.0; }), kBright);
  EXPECT_NEAR(p.counts[1], -5.0, 0.05);
  EXPECT_LT(p.std_counts[1], 0.4);
}

// A background that is lit on one side shows the pedestal on the other.
TEST(Pedestal, IsThatOfTheDarkestPart) {
  const Pedestal p =
      pedestal_of(frame_over([](int x) { return 2.0 + std::max(0.0, 0.5 * (x - 80)); }), kBright);
  EXPECT_NEAR(p.counts[1], 0.5 * 2.0, 0.2);
}

// What is brighter beside the object than elsewhere may be a halo; an even background is none.
TEST(Pedestal, TellsWhatIsBrighterBesideTheObject) {
  EXPECT_EQ(pedestal_of(frame_over([](int) { return 3.0; }), kBright).beside_counts,
            (std::array<double, kRgb>{}));
  const Pedestal p =
      pedestal_of(frame_over([](int x) { return x > 80 && x < 220 ? 6.0 : 1.0; }), kBright);
  for (const double beside : p.beside_counts) EXPECT_NEAR(beside, 4.5, 0.7);
}

TEST(Pedestal, IsGuessedWhereTheObjectFillsTheFrame) {
  const RawFrame frame = frame_over([](int) { return 0.0; });
  const Pedestal p = pedestal_of(frame, {0, 0, frame.width_px, frame.height_px});
  // Rows 0, 1, 32, 33 ... of 240 are counted: four of sixteen cross the object.
  const double mean = 2000.0 * 100.0 / 320.0 * 4.0 / 16.0;
  EXPECT_EQ(p.counts[1], 0.0);
  EXPECT_NEAR(p.std_counts[1], std::hypot(1.0, 0.01 * mean), 0.02);
}

}  // namespace
}  // namespace scattermeter::capture
