// Sums of the dipole over many points for many rows, with a stated error, in time that hardly grows
// with the number of points.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/dipole_pairs.h"
#include "core/row_blocks.h"
#include "core/source_clusters.h"

namespace scattermeter {

struct DipoleSumsOptions {
  // Largest relative error of a sum: of the value by itself; of the derivatives relative to what
  // their parts (by alpha', by z, by kappa^2) add up to in size, the part by z counted as the
  // value. Domain: 1e-5 .. 0.5.
  double tolerance = 1e-4;
  // Up to so many points of weight > 0 all pairs are summed, which is then cheaper: measured on a
  // cube of 20 mm with 10^4 rows (`bench sums`), clusters are slower with 10^3 points and 1.3 times
  // (tolerance 1e-4) to 1.9 times (1e-2) faster with 10^4.
  std::size_t direct_up_to = 4096;
};

// Work done; the same for any number of threads.
struct DipoleSumsCount {
  std::int64_t rows = 0;
  std::int64_t points = 0;           // of weight > 0
  std::int64_t points_left_out = 0;  // of weight 0
  std::int64_t pairs = 0;            // of a row and a point, of any medium
  std::int64_t exact_pairs = 0;      // in double precision: places that floats do not resolve
  std::int64_t series = 0;           // of a row and a cluster's series
  std::int64_t coefficients = 0;     // in these
  std::int64_t dropped = 0;          // clusters left out by a block of rows: too little light
  std::int64_t tests = 0;            // of clusters against blocks of rows
  std::int64_t repeated_blocks = 0;  // whose first guess of their light was too high
  // The largest bound of a row's error, as `tolerance` counts it.
  double certified_error = 0;
};

// Sum over the points of c_k R(|row - x_k|) and its derivatives, for each medium: out[m][row], rows
// in the order given to RowBlocks. Near points are summed one by one; farther clusters by their
// Taylor series (core/dipole_kernels.h) of the least degree whose rest, bounded by the poles'
// largest derivatives (core/kernel_bounds.h) and the cluster's absolute moments, is below an even
// share of the tolerance times what the rows receive. The bounds add up, for each row by its own
// distances; shares are fitted to a block of rows such that most of the tolerance is used. The sum
// is held against the rows' own sums afterwards, and the block repeated with smaller shares where
// it is over the tolerance, so the tolerance is a bound, not an estimate. Single precision adds at
// most kDipoleSumsRounding (measured). Both hold as long as a sum is over 1e-30 of what it were
// with all points at the row; below, errors are that small. Parallel; the same digits for any
// number of threads. std::invalid_argument for a tolerance out of its domain, a medium that Dipole
// refuses, or outputs of the wrong size.
inline constexpr double kDipoleSumsRounding = 3e-6;
DipoleSumsCount sum_dipoles(const SourceClusters& sources, const RowBlocks& rows,
                            std::span<const Medium> media, std::span<std::vector<DipoleSum>> out,
                            const DipoleSumsOptions& options = {});

}  // namespace scattermeter
