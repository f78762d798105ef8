#include "core/sums/series_kernels.h"

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/sums/moment_kernels.h"
#include "core/sums/series_coefficients.h"

namespace scattermeter {
namespace {

constexpr std::size_t kPoints = 30;
constexpr double kCenter_mm[3] = {1.0, 2.0, 3.0};

// Points in a cube of half-edge 1 mm about the centre, or in its plane z = 3.
struct Cluster {
  std::vector<double> x, y, z;
  std::vector<float> dx, dy, dz, weight;

  explicit Cluster(bool planar) {
    std::mt19937 random(4);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    for (std::size_t i = 0; i < kPoints; ++i) {
      dx.push_back(static_cast<float>(uniform(random)));
      dy.push_back(static_cast<float>(uniform(random)));
      dz.push_back(planar ? 0.0F : static_cast<float>(uniform(random)));
      x.push_back(kCenter_mm[0] + double(dx.back()));
      y.push_back(kCenter_mm[1] + double(dy.back()));
      z.push_back(kCenter_mm[2] + double(dz.back()));
      weight.push_back(static_cast<float>((1.0 + 0.5 * uniform(random)) / kPoints));
    }
  }
};

// Rows about 12 mm away, along a line that is neither parallel nor at a right angle to the plane.
RowLanes far_rows() {
  RowLanes rows;
  for (std::size_t i = 0; i < kRowLanes; ++i) {
    rows.x[i] = 9.0 + 0.1 * static_cast<double>(i);
    rows.y[i] = -6.0;
    rows.z[i] = 6.0;
  }
  return rows;
}

// The series tends to the direct sum with the degree, by about (radius / distance)^2 each step.
TEST(SeriesKernels, TendToTheDirectSum) {
  const std::vector<KernelDipole> media = {{0.5, 1.8, 0.1}, {1.5, 4.0, 0.3}};
  constexpr float kFrame[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  const double radius_mm = std::sqrt(3.0);
  const RowLanes rows = far_rows();
  for (const bool planar : {false, true}) {
    const Cluster cluster(planar);
    const KernelPoints points{{kCenter_mm[0], kCenter_mm[1], kCenter_mm[2]},
                              cluster.dx.data(),
                              cluster.dy.data(),
                              cluster.dz.data(),
                              cluster.weight.data(),
                              kPoints};
    double weight = 0.0;
    for (const float w : cluster.weight) weight += double(w);
    KernelMoments moments;
    sum_moments(cluster.x.data(), cluster.y.data(), cluster.z.data(), cluster.weight.data(),
                kPoints, kCenter_mm, radius_mm, kFrame, planar, kLargestDegree, moments);
    std::vector<float> coefficients(coefficient_index(kLargestDegree + 1, 0, planar));
    series_coefficients(moments, planar, kLargestDegree, weight, coefficients.data());
    std::vector<LaneSums> direct(media.size());
    add_point_sums(media, rows, {&points, 1}, 1.0, direct);
    for (const char* set : {"SSE4", "AVX2", "AVX3", ""}) {
      if (!choose_kernel_instruction_set(set)) continue;
      for (const int degree : kDegrees) {
        const KernelSeries series{{{kCenter_mm[0], kCenter_mm[1], kCenter_mm[2]},
                                   radius_mm,
                                   kFrame,
                                   coefficients.data(),
                                   planar},
                                  degree,
                                  weight};
        std::vector<LaneSums> sums(media.size());
        add_cluster_sums(media, rows, {&series, 1}, sums);
        // The mean of the points is not the centre: degree 1 is the weight alone.
        const double error = degree == 1 ? 0.3 : 3.0 * std::pow(0.2, degree) + 2e-6;
        for (std::size_t m = 0; m < media.size(); ++m) {
          for (std::size_t i = 0; i < kRowLanes; ++i) {
            EXPECT_NEAR(sums[m].value[i] / direct[m].value[i], 1.0, error)
                << set << " degree " << degree << " planar " << planar;
            EXPECT_NEAR(sums[m].z_d_z[i] / direct[m].z_d_z[i], 1.0, error)
                << set << " degree " << degree << " planar " << planar;
            EXPECT_NEAR(sums[m].decay[i] / direct[m].decay[i], 1.0, error)
                << set << " degree " << degree << " planar " << planar;
          }
        }
      }
    }
  }
  choose_kernel_instruction_set("");
}

TEST(SeriesKernels, RestsAreRoundedUp) {
  const RowLanes rows = far_rows();
  constexpr double kPole_mm = 0.5;
  for (const int power : {1, 3, 5}) {
    const LaneRest rest{{kCenter_mm[0], kCenter_mm[1], kCenter_mm[2]}, 6.0, 0.25, power};
    double lanes[kRowLanes];
    std::fill(std::begin(lanes), std::end(lanes), 2.0);
    add_lane_rests(rows, {&rest, 1}, kPole_mm, lanes);
    for (std::size_t i = 0; i < kRowLanes; ++i) {
      const double d2 = std::pow(rows.x[i] - kCenter_mm[0], 2) +
                        std::pow(rows.y[i] - kCenter_mm[1], 2) +
                        std::pow(rows.z[i] - kCenter_mm[2], 2) + kPole_mm * kPole_mm;
      const double truth = 0.25 * std::pow(36.0 / d2, power);
      EXPECT_GE(lanes[i] - 2.0, truth);
      EXPECT_LE(lanes[i] - 2.0, 1.006 * truth);
    }
  }
}

TEST(SeriesKernels, CoefficientsAreCounted) {
  // In degree n: monomials of degree n, n - 2, ..
  EXPECT_EQ(coefficient_index(0, 0, false), 0U);
  EXPECT_EQ(coefficient_index(1, 0, false), 1U);
  EXPECT_EQ(coefficient_index(2, 0, false), 4U);
  EXPECT_EQ(coefficient_index(2, 1, false), 10U);
  EXPECT_EQ(coefficient_index(3, 0, false), 11U);
  EXPECT_EQ(coefficient_index(2, 1, true), 6U);
  EXPECT_EQ(coefficient_index(3, 0, true), 7U);
}

}  // namespace
}  // namespace scattermeter
