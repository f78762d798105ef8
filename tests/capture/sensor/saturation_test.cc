#include "capture/sensor/saturation.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capture/raw/raw_reader.h"
#include "capture/raw/tone_curve.h"
#include "capture/sensor/sensor.h"
#include "tests/fixtures/shared_file.h"

namespace scattermeter::capture {
namespace {

using testing::Each;
using testing::ElementsAre;

constexpr int kFrameWidth = 400;
constexpr int kFrameHeight = 300;

using LevelAt = float (*)(int x, int y);

struct Shot {
  LevelAt scene;
  SensorModel sensor{};
  int ceiling_counts = 65535;  // the body saturates here, below its nominal white
  int ceiling_phase = -1;      // only this phase; -1: all
  std::uint64_t seed = 1;
};

RawFrame frame_of(const Shot& shot) {
  std::vector<float> signal;
  for (int y = 0; y < kFrameHeight; ++y) {
    for (int x = 0; x < kFrameWidth; ++x) signal.push_back(shot.scene(x, y));
  }
  RawFrame frame;
  frame.width_px = kFrameWidth;
  frame.height_px = kFrameHeight;
  frame.black_counts = {64, 64, 64, 64};
  frame.white_counts = 4095;
  frame.curve_levels = shot.sensor.tone_curve;
  frame.samples = expose(signal, kFrameWidth, kFrameHeight, shot.sensor, shot.seed);
  for (std::size_t i = 0; i < frame.samples.size(); ++i) {
    std::uint16_t& sample = frame.samples[i];
    if (!frame.curve_levels.empty()) sample = frame.curve_levels[sample];
    const int phase = static_cast<int>(2 * (i / kFrameWidth % 2) + i % kFrameWidth % 2);
    if (shot.ceiling_phase >= 0 && shot.ceiling_phase != phase) continue;
    sample = static_cast<std::uint16_t>(std::min<int>(sample, shot.ceiling_counts));
  }
  return frame;
}

SensorModel without_noise() {
  SensorModel sensor;
  sensor.noise_on = false;
  return sensor;
}

float flat(int /*x*/, int /*y*/) { return 3000.0F; }
float wedge(int x, int /*y*/) { return 9.0F * static_cast<float>(x); }
float dome(int x, int y) {
  const double r2 = std::pow(x - 200, 2) + std::pow(y - 150, 2);
  return static_cast<float>(3500 * std::exp(-r2 / 8000));
}
// Two uniform patches on a dark ground, as of a colour chart.
float chart(int x, int y) { return y < 20 ? 100.0F : (x < 200 ? 2900.0F : 3100.0F); }
// A uniform face next to a shaded one.
float face(int x, int y) { return y < 150 ? 3000.0F : 7.0F * static_cast<float>(x); }

// Uniform pieces of 10 x 10 samples at scattered levels; the largest piece is the brightest.
float facets(int x, int y) {
  const int piece = x / 10 + 40 * (y / 10);
  return x > 300 && y > 200 ? 3300.0F : 400.0F + static_cast<float>(piece * 7919 % 2800);
}

// A uniform face above a slope of half a count per sample of a phase: every second difference is 1.
float slope(int x, int y) { return y < 100 ? 3200.0F : 3000.0F + 0.25F * static_cast<float>(x); }

constexpr LevelAt kScenes[] = {flat, wedge, dome, chart, face, facets, slope};

TEST(ClipLevels, WhiteLevelOfTheFile) {
  RawFrame frame;
  frame.white_counts = 3999;
  EXPECT_THAT(clip_levels(frame), Each(3999));
}

TEST(ClipLevels, TopOfTheCurveBelowTheWhiteLevel) {
  RawFrame frame;
  frame.white_counts = 4095;
  frame.curve_levels = nef_lossy_curve();
  EXPECT_THAT(clip_levels(frame), Each(3880));
  frame.white_counts = 3000;
  EXPECT_THAT(clip_levels(frame), Each(3000));
}

TEST(ClipLevels, PileBelowTheWhiteLevel) {
  Shot shot{wedge};
  shot.ceiling_counts = 3100;
  EXPECT_THAT(clip_levels(frame_of(shot)), Each(3100));
  shot.scene = dome;
  EXPECT_THAT(clip_levels(frame_of(shot)), Each(3100));
  shot.scene = chart;  // cuts the brighter patch near its mean, 3164
  EXPECT_THAT(clip_levels(frame_of(shot)), Each(3100));
}

TEST(ClipLevels, PileOfOnePhaseOnly) {
  Shot shot{wedge};
  shot.ceiling_counts = 3100;
  shot.ceiling_phase = 2;
  EXPECT_THAT(clip_levels(frame_of(shot)), ElementsAre(4095, 4095, 3100, 4095));
}

TEST(ClipLevels, PileUnderALossyCurve) {
  Shot shot{wedge};
  shot.sensor.tone_curve = nef_lossy_curve();
  const auto level = shot.sensor.tone_curve[620];
  shot.ceiling_counts = level;
  EXPECT_THAT(clip_levels(frame_of(shot)), Each(level));
}

TEST(ClipLevels, PileOfATwelveBitBodyInAFourteenBitFile) {
  Shot shot{wedge};
  shot.ceiling_counts = 3100;
  RawFrame frame = frame_of(shot);
  for (std::uint16_t& sample : frame.samples) sample = static_cast<std::uint16_t>(4 * sample);
  frame.black_counts = {256, 256, 256, 256};
  frame.white_counts = 16383;
  EXPECT_THAT(clip_levels(frame), Each(12400));
}

TEST(ClipLevels, NoiseAloneIsNoPile) {
  // 7 scenes x 8 gains and curves x 4 seeds x 4 phases; see the rule for its false alarms.
  for (const LevelAt scene : kScenes) {
    // 100 electrons per count leave so little noise that hundreds of samples share the top level.
    for (const double gain : {2.0, 6.0, 40.0, 100.0}) {
      for (std::uint64_t seed = 0; seed < 4; ++seed) {
        Shot shot{scene};
        shot.sensor.noise.gain_e_per_count = gain;
        shot.seed = seed;
        EXPECT_THAT(clip_levels(frame_of(shot)), Each(4095)) << gain << ", seed " << seed;
        shot.sensor.tone_curve = nef_lossy_curve();
        EXPECT_THAT(clip_levels(frame_of(shot)), Each(3880)) << gain << ", seed " << seed;
      }
    }
  }
}

// Digital gain in the camera leaves combs: here every second value is met three times as often.
TEST(ClipLevels, CombIsNoPile) {
  RawFrame frame = frame_of({flat});
  std::mt19937 generator(5);
  std::discrete_distribution<int> comb({1, 3, 1, 3, 1, 3, 1, 3, 1, 3});
  for (std::uint16_t& sample : frame.samples) {
    sample = static_cast<std::uint16_t>(3000 + comb(generator));
  }
  EXPECT_THAT(clip_levels(frame), Each(4095));
}

TEST(ClipLevels, FrameComputedWithoutNoiseIsNoPile) {
  for (const LevelAt scene : kScenes) {
    Shot shot{scene, without_noise()};
    EXPECT_THAT(clip_levels(frame_of(shot)), Each(4095));
    shot.sensor.tone_curve = nef_lossy_curve();
    EXPECT_THAT(clip_levels(frame_of(shot)), Each(3880));
  }
}

TEST(ClipLevels, PileBelowAQuarterOfWhiteIsAScene) {
  Shot shot{wedge};
  shot.ceiling_counts = 1023;
  EXPECT_THAT(clip_levels(frame_of(shot)), Each(4095));
  shot.ceiling_counts = 1024;
  EXPECT_THAT(clip_levels(frame_of(shot)), Each(1024));
}

// Defect pixels and the like are recorded above the level at which all others saturate.
TEST(ClipLevels, OutliersAboveThePileAreClippedWithIt) {
  for (const bool curve : {false, true}) {
    Shot shot{wedge};
    if (curve) shot.sensor.tone_curve = nef_lossy_curve();
    const int level = curve ? shot.sensor.tone_curve[620] : 3100;
    shot.ceiling_counts = level;
    const RawFrame frame = frame_of(shot);
    // Every `every`-th sample of phase 0 that piles up lies above the pile, at one of `values`.
    const auto with_outliers = [&](int every, int values) {
      RawFrame changed = frame;
      int met = 0;
      for (int y = 0; y < kFrameHeight; y += 2) {
        for (int x = 0; x < kFrameWidth; x += 2) {
          auto& sample = changed.samples[static_cast<std::size_t>(y * kFrameWidth + x)];
          if (sample != level || ++met % every != 0) continue;
          const int above = 1 + met / every % values;
          sample = static_cast<std::uint16_t>(curve ? shot.sensor.tone_curve.at(620 + above)
                                                    : level + 7 * above);
        }
      }
      EXPECT_GT(met, 3000);
      return clip_levels(changed);
    };
    EXPECT_THAT(with_outliers(3000, 1), Each(level)) << "a single one";
    EXPECT_THAT(with_outliers(100, 1), Each(level)) << "one per cent, all of the same value";
    EXPECT_THAT(with_outliers(40, 50), Each(level)) << "of many values";
    EXPECT_EQ(with_outliers(8, 50)[0], curve ? 3880 : 4095) << "as many as a scene has";
  }
}

// Defect pixels that reach the nominal white level are no pile-up of their own.
TEST(ClipLevels, OutliersAtTheWhiteLevel) {
  Shot shot{wedge};
  shot.ceiling_counts = 3100;
  RawFrame frame = frame_of(shot);
  for (std::size_t i = 0; i < 60; ++i) {
    frame.samples[2 * i] = static_cast<std::uint16_t>(i < 40 ? 4095 : 3200 + 10 * i);
  }
  EXPECT_THAT(clip_levels(frame), Each(3100));
}

TEST(ClipLevels, PhotographWithASaturatedPatch) {
  const std::string path = shared_file("data/raw/nikon_d2h_12bit_compressed.nef");
  if (!std::filesystem::exists(path)) GTEST_SKIP() << shared_file_missing(path);
  RawFrame frame = read_raw(path);
  const auto clipped_greens = [&] {
    const std::array<double, 4> clip = clip_levels(frame);
    std::size_t clipped = 0;
    for (int y = 0; y < frame.height_px; ++y) {
      for (int x = y % 2; x < frame.width_px; x += 2) {
        clipped += frame.at(x, y) >= clip[static_cast<std::size_t>(3 * (y % 2))] ? 1U : 0U;
      }
    }
    return clipped;
  };
  EXPECT_THAT(clip_levels(frame), ElementsAre(3908, 4095, 4095, 3908));
  EXPECT_EQ(clipped_greens(), 35'826U);
  // A blue sample of this frame is one level higher, at 3923; a green one must free no other.
  ASSERT_EQ(std::count(frame.samples.begin(), frame.samples.end(), 3923), 1);
  frame.samples[0] = 3923;
  const auto last = frame.samples.size() - 1;
  frame.samples[last] = 4011;
  EXPECT_THAT(clip_levels(frame), ElementsAre(3908, 4095, 4095, 3908));
  EXPECT_EQ(clipped_greens(), 35'828U);
}

TEST(ClipLevels, FewerThan37SamplesAreNoPile) {
  RawFrame frame = frame_of({wedge, {}, 3000});
  // Only `pile` samples of phase 0 stay at 3500, all others lie below 3000.
  const auto with_pile = [&](std::size_t pile) {
    RawFrame changed = frame;
    for (std::size_t i = 0; i < pile; ++i) changed.samples[2 * i] = 3500;
    for (std::uint16_t& sample : changed.samples) {
      if (sample == 3000) sample = 2900;
    }
    return clip_levels(changed)[0];
  };
  EXPECT_EQ(with_pile(36), 4095);
  EXPECT_EQ(with_pile(100), 3500);
}

}  // namespace
}  // namespace scattermeter::capture
