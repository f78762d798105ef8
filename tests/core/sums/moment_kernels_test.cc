#include "core/sums/moment_kernels.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace scattermeter {
namespace {

// Two points at (1, 0, 0) and (0, 0.5, 0) of the frame, in units of a radius of 2 mm, of weight 3
// and 5; the frame's axes are y, z, x.
TEST(MomentKernels, ByHand) {
  const std::vector<double> x = {7.0, 7.0}, y = {12.0, 10.0}, z = {-1.0, 0.0};
  const std::vector<float> weight = {3.0F, 5.0F};
  constexpr double kCenter_mm[3] = {7.0, 10.0, -1.0};
  constexpr float kFrame[9] = {0, 1, 0, 0, 0, 1, 1, 0, 0};
  for (const bool planar : {false, true}) {
    KernelMoments moments;
    sum_moments(x.data(), y.data(), z.data(), weight.data(), 2, kCenter_mm, 2.0, kFrame, planar, 2,
                moments);
    // 1; x, y(, z); xx, xy, yy(, xz, yz, zz).
    const std::vector<float> truth = planar
                                         ? std::vector<float>{8, 3, 2.5F, 3, 0, 1.25F}
                                         : std::vector<float>{8, 3, 2.5F, 0, 3, 0, 1.25F, 0, 0, 0};
    for (std::size_t i = 0; i < truth.size(); ++i) EXPECT_FLOAT_EQ(moments.raw[i], truth[i]) << i;
    for (std::size_t i = 0; i < std::size(kDegrees); ++i) {
      EXPECT_FLOAT_EQ(moments.absolute[i],
                      3.0F + 5.0F * static_cast<float>(std::pow(0.5, kDegrees[i] + 1)));
    }
  }
}

// More points than lanes, a number that does not fill them: as one point of all the weight.
TEST(MomentKernels, EveryPointCountsOnce) {
  constexpr std::size_t kPoints = 37;
  const std::vector<double> x(kPoints, 1.0), y(kPoints, 2.0), z(kPoints, 3.0);
  const std::vector<float> weight(kPoints, 0.25F);
  constexpr double kCenter_mm[3] = {0.5, 2.5, 2.0};
  constexpr float kFrame[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  KernelMoments many, one;
  sum_moments(x.data(), y.data(), z.data(), weight.data(), kPoints, kCenter_mm, 2.0, kFrame, false,
              kLargestDegree, many);
  const float all = 0.25F * kPoints;
  sum_moments(x.data(), y.data(), z.data(), &all, 1, kCenter_mm, 2.0, kFrame, false, kLargestDegree,
              one);
  for (std::size_t i = 0; i < 165; ++i) EXPECT_NEAR(many.raw[i], one.raw[i], 1e-6F) << i;
}

}  // namespace
}  // namespace scattermeter
