#include "core/sums/pair_kernels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include "core/sums/dipole_kernels.h"

namespace scattermeter {
namespace {

constexpr std::array<const char*, 5> kSets = {"AVX3", "AVX2", "SSE4", "SSE2", "EMU128"};

class PairKernels : public ::testing::Test {
 protected:
  ~PairKernels() override { choose_kernel_instruction_set(""); }
  float number(float from, float to) {
    return std::uniform_real_distribution<float>(from, to)(random_);
  }

 private:
  std::mt19937 random_{5};
};

template <int kLanes>
SourcePoints<kLanes> three_or_six() {
  SourcePoints<kLanes> out;
  for (int i = 0; i < (kLanes == 4 ? 3 : 6); ++i) {
    const auto at = static_cast<float>(i);
    out.x[i] = 0.1F * at;
    out.y[i] = 0.3F - 0.2F * at;
    out.z[i] = 0.05F * at * at;
    out.power[i] = 1.0F + at;
  }
  return out;
}

// Distances and powers of points by hand, with each instruction set the same digits.
TEST_F(PairKernels, PointsAreThoseOfTheSet) {
  const auto three = three_or_six<4>();
  const auto six = three_or_six<8>();
  constexpr int kTimes = 5;
  constexpr std::array<float, 8> kEven = {0.2F, 0.2F, 0.2F, 0.1F, 0.1F, 0.1F};
  std::vector<PlacedPoints<4>> threes;
  std::vector<PlacedPoints<8>> sixes;
  for (int k = 0; k < kTimes; ++k) {
    threes.push_back({&three, number(-2, 2), number(-2, 2), number(-2, 2), 1.0F, 0.5F, 0.0F});
    sixes.push_back({&six, number(-2, 2), number(-2, 2), number(-2, 2), number(-1, 1), 0.7F, 3.0F});
  }
  std::vector<float> d2_of_three(3 * kTimes), power_of_three, d2_of_six(6 * kTimes), power_of_six;
  for (const auto& set : threes) {
    for (int i = 0; i < 3; ++i) power_of_three.push_back(0.5F * three.power[i]);
    for (int i = 0; i < 3; ++i) {
      const float x = set.x + three.x[i], y = set.y + three.y[i], z = set.z + three.z[i];
      d2_of_three[power_of_three.size() - 3 + static_cast<std::size_t>(i)] = x * x + y * y + z * z;
    }
  }
  for (const auto& set : sixes) {
    for (int i = 0; i < 6; ++i) {
      const float x = set.x + set.scale * six.x[i], y = set.y + set.scale * six.y[i];
      const float z = set.z + set.scale * six.z[i];
      d2_of_six[power_of_six.size()] = x * x + y * y + z * z;
      power_of_six.push_back(0.7F * six.power[i] + 3.0F * kEven[static_cast<std::size_t>(i)]);
    }
  }
  for (const char* name : kSets) {
    if (!choose_kernel_instruction_set(name)) continue;
    std::vector<float> d2(6 * kTimes + 2), power(6 * kTimes + 2);
    three_point_pairs(threes.data(), kTimes, d2.data(), power.data());
    for (std::size_t i = 0; i < 3 * kTimes; ++i) {
      EXPECT_EQ(d2[i], d2_of_three[i]) << name;
      EXPECT_EQ(power[i], power_of_three[i]) << name;
    }
    six_point_pairs(sixes.data(), kTimes, kEven.data(), d2.data(), power.data());
    for (std::size_t i = 0; i < 6 * kTimes; ++i) {
      EXPECT_EQ(d2[i], d2_of_six[i]) << name;
      EXPECT_EQ(power[i], power_of_six[i]) << name;
    }
  }
}

// The four pairs keep the mean of the squared distance, |d|^2 + trace of both covariances, and its
// variance to second order, 4 d^T C d; also of clusters in a plane across an axis and of points.
TEST_F(PairKernels, ClustersKeepMeanAndCovariance) {
  ClusterBatch clusters;
  const std::array<float, 6> site = {0.04F, 0.01F, 0.0F, 0.03F, 0.0F, 0.0F};
  const std::array<float, 6> point = {};
  for (int i = 0; i < ClusterBatch::kSize; ++i) {
    clusters.x[i] = number(5, 9);
    clusters.y[i] = number(-9, -5);
    clusters.z[i] = number(-1, 1);
    clusters.power[i] = number(0, 2);
    if (i % 4 == 0) continue;  // a point
    clusters.xx[i] = i % 4 == 1 ? 0.0F : 0.09F;
    clusters.xy[i] = i % 4 == 1 ? 0.0F : 0.02F;
    clusters.yy[i] = 0.06F;
    clusters.zz[i] = i % 4 == 2 ? 0.0F : 0.05F;
    clusters.yz[i] = i % 4 == 2 ? 0.0F : -0.03F;
  }
  for (const auto* own : {&site, &point}) {
    std::vector<float> first_d2;
    for (const char* name : kSets) {
      if (!choose_kernel_instruction_set(name)) continue;
      std::vector<float> d2(kClusterPairs), power(kClusterPairs);
      cluster_pairs(clusters, own->data(), d2.data(), power.data());
      if (first_d2.empty()) first_d2 = d2;
      EXPECT_EQ(d2, first_d2) << name;
      for (int i = 0; i < ClusterBatch::kSize; ++i) {
        Eigen::Matrix3d c;
        c << clusters.xx[i] + (*own)[0], clusters.xy[i] + (*own)[1], clusters.xz[i] + (*own)[2],
            clusters.xy[i] + (*own)[1], clusters.yy[i] + (*own)[3], clusters.yz[i] + (*own)[4],
            clusters.xz[i] + (*own)[2], clusters.yz[i] + (*own)[4], clusters.zz[i] + (*own)[5];
        const Eigen::Vector3d d(clusters.x[i], clusters.y[i], clusters.z[i]);
        double sum = 0.0, squares = 0.0, total = 0.0;
        for (int k = 0; k < 4; ++k) {
          const auto at = static_cast<std::size_t>(k * ClusterBatch::kSize + i);
          sum += d2[at];
          total += power[at];
          const double off = d2[at] - d.squaredNorm() - c.trace();
          squares += off * off;
        }
        EXPECT_NEAR(sum / 4, d.squaredNorm() + c.trace(), 2e-5) << name << ' ' << i;
        EXPECT_FLOAT_EQ(static_cast<float>(total), clusters.power[i]);
        const double spread = 4.0 * d.dot(c * d);
        EXPECT_NEAR(squares / 4, spread, 0.02 * spread + 1e-6) << name << ' ' << i;
      }
    }
  }
}

// Whatever the instruction set and however many pairs, each counts once, in the bin of its bits.
TEST_F(PairKernels, OctavesTakeEveryPairOnce) {
  const OctaveScale scale{0.25F, 20, 0x3e800000 >> 20, 30};
  constexpr int kPairs = 37;
  std::vector<float> d2(48), power(48);
  for (std::size_t i = 0; i < 48; ++i) {
    d2[i] = number(0, 5);
    power[i] = number(0, 1);
  }
  d2[3] = 1e6F;  // beyond the last bin
  std::vector<float> expected(64);
  for (std::size_t i = 0; i < kPairs; ++i) {
    // Eight steps an octave of s, evenly.
    const float s = d2[i] + 0.25F;
    const int octave = std::ilogb(s);
    const float step = 8.0F * (std::ldexp(s, -octave) - 1.0F);
    const int in_octave = static_cast<int>(step);
    const int bin = std::min(8 * (octave + 2) + in_octave, 30);
    const float next = power[i] * (step - static_cast<float>(in_octave));
    expected[static_cast<std::size_t>(2 * bin)] += power[i] - next;
    expected[static_cast<std::size_t>(2 * bin + 1)] += next;
  }
  for (const char* name : kSets) {
    if (!choose_kernel_instruction_set(name)) continue;
    std::vector<float> sums(64);
    add_octave_pairs(scale, d2.data(), power.data(), kPairs, sums.data());
    for (std::size_t i = 0; i < sums.size(); ++i) {
      EXPECT_FLOAT_EQ(sums[i], expected[i]) << name << ' ' << i;
    }
  }
}

}  // namespace
}  // namespace scattermeter
