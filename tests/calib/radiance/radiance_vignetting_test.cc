#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calib/radiance/radiance_steps.h"
#include "tests/fixtures/calib/radiance_bench.h"

namespace scattermeter::calib {
namespace {

using ::testing::HasSubstr;

// Blocks whose light is that of a known vignetting, without noise.
class RadianceVignettingTest : public ::testing::Test {
 protected:
  RadianceVignettingTest() {
    bench_.know_dark();
    truth_ = vignetting_of_frame(RadianceBench::kWidth, RadianceBench::kHeight);
    truth_.radial = {std::vector<double>{-0.2}, {-0.25}, {-0.3}};
    bench_.steps.blocks = blocks_of_frame(RadianceBench::kWidth, RadianceBench::kHeight, 12, 8);
    for (const Block& b : bench_.steps.blocks) {
      const auto c =
          static_cast<std::size_t>(bench_.steps.cfa.phase[static_cast<std::size_t>(b.phase)]);
      double sum = 0, n = 0;
      for (int y = b.y0; y < b.y1; y += 2) {
        for (int x = b.x0; x < b.x1; x += 2) {
          sum += truth_.share(x, y, c);
          n += 1.0;
        }
      }
      bench_.steps.light.push_back({5000.0 * sum / n, 1e-6, n, Eigen::VectorXd(0)});
    }
  }
  RadianceBench bench_;
  Vignetting truth_;
};

TEST_F(RadianceVignettingTest, FindsWhatTheBlocksShow) {
  find_vignetting(bench_.steps);
  const Vignetting& found = bench_.calibration.correction.vignetting;
  for (std::size_t c = 0; c < kRgb; ++c) {
    for (const auto& [x, y] : {std::pair{0, 0}, {95, 63}, {48, 32}, {10, 50}}) {
      EXPECT_NEAR(found.share(x, y, c), truth_.share(x, y, c), 2e-3) << c << " " << x;
    }
  }
  EXPECT_GT(bench_.calibration.correction.vignetting_std, 0.0);
  EXPECT_LT(bench_.calibration.correction.vignetting_std, 2e-3);
}

// A share g of the frame's mean on every pixel is taken away before.
TEST_F(RadianceVignettingTest, GlareIsNoLightOfTheCorners) {
  const double share = 0.05;
  bench_.calibration.correction.glare_share.fill(share / (1 + share));
  std::array<double, kRgb> sum{}, n{};
  const auto colour = [&](std::size_t k) {
    return static_cast<std::size_t>(
        bench_.steps.cfa.phase[static_cast<std::size_t>(bench_.steps.blocks[k].phase)]);
  };
  for (std::size_t k = 0; k < bench_.steps.light.size(); ++k) {
    sum[colour(k)] += bench_.steps.light[k].per_s * bench_.steps.light[k].samples;
    n[colour(k)] += bench_.steps.light[k].samples;
  }
  for (std::size_t k = 0; k < bench_.steps.light.size(); ++k) {
    bench_.steps.light[k].per_s += share * sum[colour(k)] / n[colour(k)];
  }
  find_vignetting(bench_.steps);
  EXPECT_NEAR(bench_.calibration.correction.vignetting.share(0, 0, 1), truth_.share(0, 0, 1), 2e-3);
}

TEST_F(RadianceVignettingTest, RefusesTooFewBlocks) {
  for (std::size_t k = 8; k < bench_.steps.light.size(); ++k) bench_.steps.light[k] = {};
  EXPECT_THAT(refusal_of([&] { find_vignetting(bench_.steps); }), HasSubstr("too few"));
}

}  // namespace
}  // namespace scattermeter::calib
