// bench rig: what errors of the rig do to the answers, and whether the uncertainty holds them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/bench/estimate_statistics.h"
#include "apps/report/plot.h"
#include "core/base/progress.h"

namespace scattermeter::apps {

// Errors are normal with these deviations, which are also what the measuring rig is told.
struct RigBenchOptions {
  int draws = 20;  // >= 2
  std::uint64_t seed = 1;
  int image_width_px = 968;
  double led_position_std_mm = 0.2;  // each LED, each coordinate
  double led_power_relative_std = 0.01;
  double point_std_px = 0.3;  // each coordinate of each pose point
  Progress* progress = nullptr;
};

// One shot measured alone, in one draw.
struct SingleShotEstimate {
  std::string shot;
  std::string material;
  char channel = 'R';
  int draw = 0;
  bool refused = false;
  double sigma_s_prime_per_mm = 0;  // NaN where refused
  double sigma_a_per_mm = 0;
};

// One coefficient of a material in a channel.
struct RigBenchQuantity {
  // Standard deviation over mean of the answers of the material's shots, each measured alone: root
  // mean square over the draws.
  double single_shot_variation = 0;
  EstimateStatistics joint;  // all shots at once, over the draws
};

struct RigBenchRow {
  std::string material;
  char channel = 'R';
  RigBenchQuantity sigma_s_prime_per_mm;
  RigBenchQuantity sigma_a_per_mm;
  double refused_single = 0;  // shares; refused answers count nowhere else
  double refused_joint = 0;
};

struct RigBench {
  std::vector<RigBenchRow> rows;
  std::vector<SingleShotEstimate> singles;
};

// Draws rigs about plastics_rig(): the shots are rendered with LEDs displaced and of other power
// than told, and measured with the nominal rig, whose pose points are off. One exposure a draw.
// std::invalid_argument for fewer than two draws or a negative deviation.
RigBench bench_rig(const RigBenchOptions& options);

std::string rig_bench_table(const RigBench& bench);
std::string rig_bench_csv(const RigBench& bench);
std::string single_shot_csv(const RigBench& bench);
Plot rig_bench_plot(const RigBench& bench);

}  // namespace scattermeter::apps
