// The dipole's inner loops, on the processor's best vectors: rows of points side by side in lanes.
#pragma once

#include <cstddef>
#include <span>

namespace scattermeter {

inline constexpr std::size_t kRowLanes = 16;  // rows that are summed for at once

// Places in mm. Lanes without a row of their own repeat one.
struct RowLanes {
  alignas(64) double x[kRowLanes];
  alignas(64) double y[kRowLanes];
  alignas(64) double z[kRowLanes];
};

// The sums that value and derivatives are combined from: with g_i = z_i (1 + x_i) exp(-x_i) /
// rho_i^3 of core/dipole.h, over both poles, the sums of c g (unit of c / mm^2), of c z dg/dz
// (unit of c / mm^2) and of -2 c dg/d(kappa^2) (unit of c).
struct LaneSums {
  alignas(64) double value[kRowLanes];
  alignas(64) double z_d_z[kRowLanes];
  alignas(64) double decay[kRowLanes];
};

// Of one medium.
struct KernelDipole {
  double z_r_mm, z_v_mm, kappa_per_mm;
};

// Points about a centre; float is good where the distance to the poles, over z_r, is not much below
// the points' own distance from that centre.
struct KernelPoints {
  double center_mm[3];
  const float *x_mm, *y_mm, *z_mm;  // from the centre
  const float* weight;
  std::size_t count;
};

// Adds the direct sums over the points, one for each medium, times `unit` (what a weight of 1
// stands for). Precondition: as many sums as media. Relative rounding error for positive weights:
// 1e-6 (tests/core/dipole_pairs_test.cc) where the exponential is at least 1e-30.
void add_point_sums(std::span<const KernelDipole> media, const RowLanes& rows,
                    std::span<const KernelPoints> points, double unit, std::span<LaneSums> sums);

// Taylor series of a cluster of points about its centre c, in its own frame and in units of its
// radius a: with psi_q = (-1/rho d/drho)^q exp(-kappa rho)/rho, rho^2 = |r|^2 + z^2, a point at
// c + D adds psi_1(r - D) = sum over q of psi_(1+q)(r) (r.D - |D|^2/2)^q / q! at c + r, likewise
// psi_0 and psi_2. Kept are the terms of degree at most T in D; the q-th is a polynomial in r
// whose coefficients are moments of the points, the same for all media, poles and quantities.
//
// Order of the coefficients: by degree n = 0 .. T in D, then by the power m of |D|^2 (0 .. n/2),
// then monomials of degree k = n - 2m in r: by the power l of z (0 .. min(k, planar ? 0 : k)), then
// by that of y (0 .. k - l); so a series holds those of lower degree. Coefficient:
//   (-1/2)^m / (m! i! j! l!) sum over points of w |D|^2m Dx^i Dy^j Dz^l  (D in units of a).
inline constexpr int kLargestDegree = 8;
inline constexpr int kDegrees[] = {1, 2, 4, 6, 8};  // that can be summed

// Monomials of degree k, in three variables or (planar) two.
constexpr std::size_t monomials_of_degree(int k, bool planar) {
  return static_cast<std::size_t>(planar ? k + 1 : (k + 1) * (k + 2) / 2);
}

// Place of the first coefficient of degree n and power m; of (T + 1, 0): their number.
constexpr std::size_t coefficient_place(int n, int m, bool planar) {
  std::size_t at = 0;
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; 2 * j <= i && (i < n || j < m); ++j)
      at += monomials_of_degree(i - 2 * j, planar);
  }
  return at;
}

struct KernelCluster {
  double center_mm[3];
  double radius_mm;
  const float* frame;         // 9, rows are the axes; the third is the normal of planar ones
  const float* coefficients;  // for a weight of 1 in all
  bool planar;
};

// What a series of degree kDegrees[i] leaves out falls with that power of the distance at least.
inline constexpr int kFalls[] = {2, 4, 6, 8, 10};

// What a series leaves out for a row at a distance d from the cluster's centre:
// largest (nearest^2 / (d^2 + pole^2))^power.
struct LaneRest {
  double center_mm[3];
  double nearest_mm;
  double largest;
  int power;  // 1 .. 5
};

// Adds them for each row, rounded up by at most 3e-3. Precondition: no quotient is over 1.
void add_lane_rests(const RowLanes& rows, std::span<const LaneRest> rests, double pole_mm,
                    double* lanes);

// A cluster's series of a degree (one of kDegrees), times `unit`. Degree 1 is the weight at the
// centre, in any unit of length: radius_mm is then only to be neither far above nor below the
// distances.
struct KernelSeries {
  KernelCluster cluster;
  int degree;
  double unit;
};
void add_cluster_sums(std::span<const KernelDipole> media, const RowLanes& rows,
                      std::span<const KernelSeries> series, std::span<LaneSums> sums);

// Moments of points about a centre, in a frame and in units of a radius: raw[i] is the sum of
// weight times the i-th monomial, monomials of degree 0 .. `degree` in the order above;
// absolute[i] the sum of weight |D|^(kDegrees[i] + 1).
struct KernelMoments {
  float raw[165];
  float absolute[5];
};
void sum_moments(const double* x_mm, const double* y_mm, const double* z_mm, const float* weight,
                 std::size_t count, const double* center_mm, double radius_mm, const float* frame,
                 bool planar, int degree, KernelMoments& out);

// "AVX2".
const char* kernel_instruction_set();

// Restricts the kernels to sets that the given one implies, by name, for benches and tests; false
// where the processor lacks it or the build left it out. "": the best again. Not while others sum.
bool choose_kernel_instruction_set(const char* name);

}  // namespace scattermeter
