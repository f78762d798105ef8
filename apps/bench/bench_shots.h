// bench shots: run time of measuring over the number of shots.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "apps/report/plot.h"
#include "core/base/progress.h"

namespace scattermeter::apps {

struct ShotsBenchOptions {
  std::vector<int> shots = {1, 3, 10, 30, 100};  // > 0
  int image_width_px = 968;                      // 240 .. 3872
  int repeats = 3;                               // runs, of which the fastest is reported
  Progress* progress = nullptr;
};

struct ShotsBenchRow {
  int shots = 0;
  double seconds = 0;                                    // from geometry to results, all threads
  std::vector<std::pair<std::string, double>> timing_s;  // its stages
  // Of the worst of three channels, relative to the truth.
  double error_sigma_s_prime = 0;
  double error_sigma_a = 0;
  double std_sigma_s_prime = 0;  // stated
  double std_sigma_a = 0;
};

// Measures one plastic on a cube, each shot under an LED at its own position, by the dipole with
// its uncertainty; the frames are in memory, with noise. Rows are in the order of the options.
// Throws std::invalid_argument for options out of range.
std::vector<ShotsBenchRow> bench_shots(const ShotsBenchOptions& options);

std::string shots_bench_table(const std::vector<ShotsBenchRow>& rows);
std::string shots_bench_csv(const std::vector<ShotsBenchRow>& rows);
Plot shots_bench_plot(const std::vector<ShotsBenchRow>& rows);

}  // namespace scattermeter::apps
