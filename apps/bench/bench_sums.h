// bench sums: run time against error of the sums of the dipole over many patches.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/bench/bench_sums_peer.h"
#include "apps/report/plot.h"

namespace scattermeter::apps {

struct SumsBenchOptions {
  std::vector<double> patches = {1e3, 1e4, 1e5, 1e6};  // >= 100
  std::vector<double> rows = {1e4};                    // >= 1
  std::vector<double> tolerances = {1e-2, 5e-3, 1e-3, 1e-4, 1e-5};
  double loose_tolerance = 0.25;  // of the image of three channels; 0: none
  int peer_patches = 10000;       // 0: no peer
  int repeats = 3;                // >= 1; the median is reported
  std::uint64_t seed = 1;
};

// One scene, medium, and tolerance. Errors are relative to a direct sum in long double over a
// sample of the rows: of the value by itself, of the derivatives by their terms' absolute values.
struct SumsBenchRow {
  std::string body;  // "cube", 20 mm, or "sphere", 20 mm across; all of it lit
  int channels = 1;
  double patches = 0;
  double rows = 0;
  double tolerance = 0;
  double tree_s = 0;      // clusters and row blocks
  double sum_s = 0;       // all threads
  double tree_one_s = 0;  // one thread
  double sum_one_s = 0;
  double direct_ns = 0;     // a pair, one thread, one channel: the direct sum of the same run
  double speedup = 0;       // all pairs' direct time over that of one thread
  double median_error = 0;  // of the value
  double worst_error[3] = {};
  double certified_error = 0;
  double pairs_per_row = 0;
  double series_per_row = 0;
};

struct SumsBench {
  std::vector<SumsBenchRow> rows;
  std::vector<PeerResult> peers;
};

// Points are drawn evenly over the surface; rows are drawn like them. std::invalid_argument for
// options out of their domain.
SumsBench bench_sums(const SumsBenchOptions& options);

// Slope of log time (one thread, tree included) over log patches; NaN for fewer than two.
double patches_exponent(const SumsBench& bench, const std::string& body, double rows,
                        double tolerance);

std::string sums_bench_table(const SumsBench& bench);
std::string sums_bench_csv(const SumsBench& bench);
std::string sums_peer_csv(const SumsBench& bench);
Plot sums_error_plot(const SumsBench& bench);    // error over run time
Plot sums_patches_plot(const SumsBench& bench);  // run time over patches

}  // namespace scattermeter::apps
