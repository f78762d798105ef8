// Direct sums of the dipole over points, with the processor's widest vectors, one row per lane.
#pragma once

#include <cstddef>
#include <span>

namespace scattermeter {

inline constexpr std::size_t kRowLanes = 16;  // rows that are summed at once

// Positions of rows in mm. Lanes without a row of their own repeat one.
struct RowLanes {
  alignas(64) double x[kRowLanes];
  alignas(64) double y[kRowLanes];
  alignas(64) double z[kRowLanes];
};

// The sums from which value and derivatives are combined: with g_i = z_i (1 + x_i) exp(-x_i) /
// rho_i^3 of core/material/dipole.h, over both poles, the sums of c g (unit of c / mm^2), of c z
// dg/dz (unit of c / mm^2) and of -2 c dg/d(kappa^2) (unit of c).
struct LaneSums {
  alignas(64) double value[kRowLanes];
  alignas(64) double z_d_z[kRowLanes];
  alignas(64) double decay[kRowLanes];
};

// The dipole of one medium.
struct KernelDipole {
  double z_r_mm, z_v_mm, kappa_per_mm;
};

// Points relative to a centre. Single precision is sufficient where the distance to the poles is
// not much smaller than the points' distance from that centre.
struct KernelPoints {
  double center_mm[3];
  const float *x_mm, *y_mm, *z_mm;  // from the centre
  const float* weight;
  std::size_t count;
};

// Adds the direct sums over the points, one for each medium, times `unit` (the value of a weight of
// 1). Precondition: as many sums as media. Relative rounding error for positive weights: 1e-6
// (tests/core/sums/dipole_pairs_test.cc) where the exponential is at least 1e-30.
void add_point_sums(std::span<const KernelDipole> media, const RowLanes& rows,
                    std::span<const KernelPoints> points, double unit, std::span<LaneSums> sums);

// Selects the best instruction set, once; every kernel calls it.
void prepare_kernels();

// The name of the instruction set in use, such as "AVX2".
const char* kernel_instruction_set();

// Restricts the kernels to a named instruction set, for benchmarks and tests; "" returns to the
// best. False where the processor lacks it or the build left it out. Not thread-safe.
bool choose_kernel_instruction_set(const char* name);

}  // namespace scattermeter
