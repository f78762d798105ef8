// Sums of the dipole over many points for many rows, with a bound of their error, in a time that
// hardly grows with the number of points.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/sums/dipole_pairs.h"
#include "core/sums/row_blocks.h"
#include "core/sums/source_clusters.h"

namespace scattermeter {

struct DipoleSumsOptions {
  // The largest relative error of a sum: of the value relative to itself, of a derivative relative
  // to the sum of its parts' absolute values (by alpha', by z, by kappa^2; that by z as the value).
  // Domain: 1e-5 .. 0.5.
  double tolerance = 1e-4;
  // Up to this many points of weight > 0 all pairs are summed, which is then cheaper: measured on a
  // cube of 20 mm with 10^4 rows (`bench sums`), clusters are slower with 10^3 points and 1.3 times
  // (tolerance 1e-4) to 1.9 times (1e-2) faster with 10^4.
  std::size_t direct_up_to = 4096;
};

// The work done; the same for any number of threads.
struct DipoleSumsCount {
  std::int64_t rows = 0;
  std::int64_t points = 0;           // of weight > 0
  std::int64_t points_left_out = 0;  // of weight 0
  std::int64_t pairs = 0;            // of a row and a point, for all media together
  std::int64_t exact_pairs =
      0;                    // of these in double precision, where floats do not resolve positions
  std::int64_t series = 0;  // of a row and a cluster, summed by its series
  std::int64_t coefficients = 0;     // in these
  std::int64_t dropped = 0;          // clusters that give a block of rows too little light
  std::int64_t tests = 0;            // of clusters for blocks of rows
  std::int64_t repeated_blocks = 0;  // whose estimated light was too high
  // The largest bound of a row's error, relative as `tolerance` is.
  double certified_error = 0;
};

// Computes the sum over the points of c_k R(|row - x_k|) and its derivatives for each medium:
// out[m][row], rows in the order given to RowBlocks.
// Near points are summed one by one, farther clusters by their Taylor series
// (core/sums/series_kernels.h) of the lowest degree whose remainder is below a share of the
// tolerance times the light that the rows receive, by the bounds of core/sums/kernel_bounds.h and
// the cluster's absolute moments. The bounds are added up for each row by its own distances; the
// share is fitted to each block of rows so that most of the tolerance is used. Afterwards the total
// is compared with the rows' own sums, and a block above the tolerance is repeated with a smaller
// share: the tolerance is a bound, not an estimate. Measured errors are about a hundredth of it.
// Single precision adds at most kDipoleSumsRounding (measured). Both hold for sums above 1e-30 of
// that with all points at the row; below, errors are at most of that size (absolute).
// Parallel; the same digits for any number of threads. Throws std::invalid_argument for a tolerance
// outside its domain, a medium that Dipole refuses, or outputs of the wrong size.
inline constexpr double kDipoleSumsRounding = 3e-6;
DipoleSumsCount sum_dipoles(const SourceClusters& sources, const RowBlocks& rows,
                            std::span<const Medium> media, std::span<std::vector<DipoleSum>> out,
                            const DipoleSumsOptions& options = {});

}  // namespace scattermeter
