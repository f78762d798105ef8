// Taylor series of clusters of points, summed for rows side by side in lanes.
#pragma once

#include <cstddef>
#include <span>

#include "core/sums/dipole_kernels.h"

namespace scattermeter {

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
inline constexpr int kDegrees[] = {1, 2, 4, 6, 8};  // degrees that can be summed

// Monomials of degree k, in three variables or (planar) two.
constexpr std::size_t monomials_of_degree(int k, bool planar) {
  return static_cast<std::size_t>(planar ? k + 1 : (k + 1) * (k + 2) / 2);
}

// Index of the first coefficient of degree n and power m. For (T + 1, 0) it is the number of
// coefficients up to degree T.
constexpr std::size_t coefficient_index(int n, int m, bool planar) {
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

// The remainder of a series of degree kDegrees[i] falls at least with this power of the distance.
inline constexpr int kFalls[] = {2, 4, 6, 8, 10};

// A bound of a series' remainder for a row at a distance d from the cluster's centre:
// largest (nearest^2 / (d^2 + pole^2))^power.
struct LaneRest {
  double center_mm[3];
  double nearest_mm;
  double largest;
  int power;  // 1 .. 5
};

// Adds these bounds for each row, rounded up by at most 6e-3. Precondition: no quotient exceeds 1.
void add_lane_rests(const RowLanes& rows, std::span<const LaneRest> rests, double pole_mm,
                    double* lanes);

// A cluster's series of a degree (one of kDegrees), times `unit`. Degree 1 is the weight at the
// centre; radius_mm is then only the unit of length, and should be of the order of the distances.
struct KernelSeries {
  KernelCluster cluster;
  int degree;
  double unit;
};
void add_cluster_sums(std::span<const KernelDipole> media, const RowLanes& rows,
                      std::span<const KernelSeries> series, std::span<LaneSums> sums);

}  // namespace scattermeter
