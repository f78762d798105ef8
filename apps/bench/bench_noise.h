// bench noise: is the uncertainty from the noise of the raws predicted correctly?
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/bench/estimate_statistics.h"
#include "apps/report/plot.h"
#include "apps/rig/open_objects.h"
#include "apps/rig/rig.h"
#include "core/base/progress.h"

namespace scattermeter::apps {

struct NoiseBenchOptions {
  int seeds = 200;  // sets of shots, >= 2
  std::uint64_t seed = 1;
  Progress* progress = nullptr;
};

// One material and channel. Refused estimates count in `refused` only.
struct NoiseBenchRow {
  std::string material;
  char channel = 'R';
  EstimateStatistics sigma_s_prime_per_mm;
  EstimateStatistics sigma_a_per_mm;
  double refused = 0;  // share
};

// Renders the rig's truth once, exposes it to raws in memory once per seed, and measures every set
// jointly. Only the noise differs: rig and truth are the same for all. Throws InputError for a rig
// without truth, std::invalid_argument for fewer than two seeds.
std::vector<NoiseBenchRow> bench_noise(const Rig& rig, const ObjectScenes& objects,
                                       const NoiseBenchOptions& options);

std::string noise_bench_table(const std::vector<NoiseBenchRow>& rows);
std::string noise_bench_csv(const std::vector<NoiseBenchRow>& rows);
Plot noise_bench_plot(const std::vector<NoiseBenchRow>& rows);

}  // namespace scattermeter::apps
