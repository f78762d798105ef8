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
                    const KernelPoints& points, double unit, std::span<LaneSums> sums);

// "AVX2".
const char* kernel_instruction_set();

// Restricts the kernels to sets that the given one implies, by name, for benches and tests; false
// where the processor lacks it or the build left it out. "": the best again. Not while others sum.
bool choose_kernel_instruction_set(const char* name);

}  // namespace scattermeter
