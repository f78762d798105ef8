#include "calib/led/highlight.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scattermeter::calib {
namespace {

using ::testing::HasSubstr;

const SphereImage kSphere{100, 60, 120, 120, {160.3, 119.6}, 52.0};

struct Spot {
  Eigen::Vector2d at;
  double peak = 2500.0;
  double radius_px = 2.5;  // of a disc, blurred
};

// A sphere with a dim base, red weaker than green; the disc's edge falls over 1.4 px.
CfaSamples sphere_with(const std::vector<Spot>& spots, double clip, std::uint64_t seed) {
  CfaSamples s;
  s.x0 = kSphere.x0;
  s.y0 = kSphere.y0;
  s.width = kSphere.width;
  s.height = kSphere.height;
  s.channel_of_phase = {0, 1, 1, 2};
  s.exposure_s = 0.1;
  std::mt19937_64 generator(seed);
  std::normal_distribution<double> normal;
  for (int y = s.y0; y < s.y0 + s.height; ++y) {
    for (int x = s.x0; x < s.x0 + s.width; ++x) {
      const Eigen::Vector2d p(x, y);
      double v = (p - kSphere.center_px).norm() < kSphere.radius_px ? 8.0 : 0.0;
      const double colour = s.channel(x, y) == 0 ? 0.6 : 1.0;
      for (const Spot& spot : spots) {
        const double r = (p - spot.at).norm();
        v += colour * spot.peak * 0.5 * std::erfc((r - spot.radius_px) / 1.0);
      }
      const double variance = v / 6.0 + 1.0;
      v += std::sqrt(variance) * normal(generator);
      s.clipped.push_back(v >= clip ? 1 : 0);
      s.signal_counts.push_back(static_cast<float>(std::min(v, clip)));
      s.variance_counts2.push_back(static_cast<float>(variance));
    }
  }
  return s;
}

TEST(Highlight, FindsItsMiddleWithoutBias) {
  constexpr int kDraws = 200;
  std::mt19937_64 generator(7);
  std::uniform_real_distribution<double> place(-20.0, 20.0);
  for (double clip : {1e9, 1200.0, 300.0}) {
    Eigen::Vector2d mean = Eigen::Vector2d::Zero();
    double square = 0.0, predicted = 0.0;
    for (int i = 0; i < kDraws; ++i) {
      const Spot spot{kSphere.center_px + Eigen::Vector2d(place(generator), place(generator))};
      const FoundHighlight found =
          find_highlight(sphere_with({spot}, clip, static_cast<std::uint64_t>(i)), kSphere);
      ASSERT_EQ(found.problem, "");
      const Eigen::Vector2d off = found.image_px - spot.at;
      mean += off / kDraws;
      square += off.squaredNorm() / (2.0 * kDraws);
      predicted += found.std_px * found.std_px / kDraws;
      EXPECT_EQ(found.saturated_share > 0.1, clip < 1e4);
    }
    const double sampled = std::sqrt(square);
    EXPECT_LT(mean.norm(), 4.0 * sampled / std::sqrt(kDraws)) << clip;
    // What is said holds: not less than what is, and of its order.
    EXPECT_LT(sampled, 1.2 * std::sqrt(predicted)) << clip;
    EXPECT_LT(std::sqrt(predicted), 0.06) << clip;
  }
}

TEST(Highlight, TheBrightestOfTwoCounts) {
  const Spot lamp{{150.2, 110.7}};
  const Spot other{{175.0, 130.0}, 900.0};
  const FoundHighlight found = find_highlight(sphere_with({lamp, other}, 1e9, 3), kSphere);
  ASSERT_EQ(found.problem, "");
  EXPECT_LT((found.image_px - lamp.at).norm(), 0.1);
}

TEST(Highlight, SaysWhyThereIsNone) {
  EXPECT_THAT(find_highlight(sphere_with({}, 1e9, 4), kSphere).problem, HasSubstr("no highlight"));
  const Spot wide{kSphere.center_px, 2500.0, 32.0};
  EXPECT_THAT(find_highlight(sphere_with({wide}, 1e9, 5), kSphere).problem,
              HasSubstr("not a compact"));
  const Spot rim{kSphere.center_px + Eigen::Vector2d(50.5, 0.0)};
  EXPECT_THAT(find_highlight(sphere_with({rim}, 1e9, 6), kSphere).problem, HasSubstr("rim"));
  EXPECT_THAT(find_highlight(CfaSamples{}, kSphere).problem, HasSubstr("out of view"));
}

}  // namespace
}  // namespace scattermeter::calib
