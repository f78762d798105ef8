#include "calib/radiance/vignetting_fit.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace scattermeter::calib {
namespace {

constexpr int kWidth = 240, kHeight = 160;

Vignetting truth_of(bool tilted) {
  Vignetting v = vignetting_of_frame(kWidth, kHeight);
  v.radial = {std::vector<double>{-0.3, 0.06}, {-0.28, 0.05}, {-0.33, 0.08}};
  if (tilted) v.map.fill({0.02, -0.01, 0.004, 0.0});
  return v;
}

std::vector<FlatLight> lights_of(const Vignetting& truth, double noise, std::uint64_t seed) {
  std::mt19937_64 generator(seed);
  std::normal_distribution<double> normal;
  std::vector<FlatLight> out;
  for (const Block& b : blocks_of_frame(kWidth, kHeight, 24, 16)) {
    const std::size_t colour = b.phase == 0 ? 0 : b.phase == 3 ? 2 : 1;
    double sum = 0;
    int n = 0;
    for (int y = b.y0; y < b.y1; y += 2) {
      for (int x = b.x0; x < b.x1; x += 2, ++n) sum += truth.share(x, y, colour);
    }
    const double light = 500.0 * (1.0 + static_cast<double>(colour)) * sum / n;
    out.push_back({b, colour, light * (1 + noise * normal(generator)), std::pow(light * noise, 2)});
  }
  return out;
}

double worst_error(const VignettingFit& fit, const Vignetting& truth) {
  double worst = 0;
  for (std::size_t c = 0; c < kRgb; ++c) {
    for (int x = 0; x < kWidth; x += 13) {
      for (int y = 0; y < kHeight; y += 11) {
        worst = std::max(worst, std::abs(fit.vignetting.share(x, y, c) - truth.share(x, y, c)));
      }
    }
  }
  return worst;
}

// Blocks are averaged as the light is: no bias by their size.
TEST(VignettingFit, IsExactWithoutNoise) {
  for (const bool tilted : {false, true}) {
    const Vignetting truth = truth_of(tilted);
    const VignettingFit fit = fit_vignetting(lights_of(truth, 1e-9, 1), kWidth, kHeight);
    ASSERT_TRUE(fit.ok);
    EXPECT_LT(worst_error(fit, truth), 1e-7);
  }
}

// At one place, and over the frame.
TEST(VignettingFit, KnowsItsScatter) {
  const Vignetting truth = truth_of(false);
  double squares = 0, predicted = 0, sum = 0, frame_squares = 0, frame_predicted = 0;
  constexpr int kDraws = 200;
  for (int i = 0; i < kDraws; ++i) {
    const VignettingFit fit = fit_vignetting(
        lights_of(truth, 5e-3, 100 + static_cast<std::uint64_t>(i)), kWidth, kHeight);
    ASSERT_TRUE(fit.ok);
    const double e = fit.vignetting.share(200, 30, 1) - truth.share(200, 30, 1);
    const double s = share_std(fit, 200, 30, 1);
    sum += e / kDraws;
    squares += e * e / kDraws;
    predicted += s * s / kDraws;
    frame_predicted += fit.rms_std * fit.rms_std / kDraws;
    for (std::size_t c = 0; c < kRgb; ++c) {
      for (int x = 0; x <= 8; ++x) {
        for (int y = 0; y <= 8; ++y) {
          const double at_x = (kWidth - 1.0) * x / 8;
          const double at_y = (kHeight - 1.0) * y / 8;
          const double d = fit.vignetting.share(at_x, at_y, c) - truth.share(at_x, at_y, c);
          frame_squares += d * d / (kDraws * kRgb * 81.0);
        }
      }
    }
  }
  const double scatter = std::sqrt(squares);
  EXPECT_NEAR(std::sqrt(predicted) / scatter, 1.0, 0.2);
  EXPECT_NEAR(sum, 0.0, 4 * scatter / std::sqrt(kDraws));
  EXPECT_NEAR(std::sqrt(frame_predicted / frame_squares), 1.0, 0.1);
}

TEST(VignettingFit, NeedsBlocksOfEveryColour) {
  std::vector<FlatLight> lights = lights_of(truth_of(false), 1e-3, 1);
  for (FlatLight& l : lights) l.colour = 1;
  EXPECT_FALSE(fit_vignetting(lights, kWidth, kHeight).ok);
  EXPECT_FALSE(fit_vignetting({}, kWidth, kHeight).ok);
}

}  // namespace
}  // namespace scattermeter::calib
