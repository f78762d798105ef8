// bench noise: is the uncertainty that the noise of the raws leaves predicted right?
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/bench/estimate_statistics.h"
#include "apps/instrument/open_objects.h"
#include "apps/report/plot.h"
#include "apps/rig/rig.h"
#include "core/base/progress.h"

namespace scattermeter::apps {

struct NoiseBenchOptions {
  int seeds = 200;  // sets of shots, >= 2
  std::uint64_t seed = 1;
  Progress* progress = nullptr;
};

// One material and channel. Answers that were refused count in `refused` and nowhere else.
struct NoiseBenchRow {
  std::string material;
  char channel = 'R';
  EstimateStatistics sigma_s_prime_per_mm;
  EstimateStatistics sigma_a_per_mm;
  double refused = 0;  // share
};

// Renders the rig's truth once, exposes it to raws in memory once a seed, and measures every set
// jointly. Only the noise is drawn anew: rig and truth are the same throughout. Throws InputError
// for a rig without truth; std::invalid_argument for fewer than two seeds.
std::vector<NoiseBenchRow> bench_noise(const Rig& rig, const ObjectScenes& objects,
                                       const NoiseBenchOptions& options);

std::string noise_bench_table(const std::vector<NoiseBenchRow>& rows);
std::string noise_bench_csv(const std::vector<NoiseBenchRow>& rows);
Plot noise_bench_plot(const std::vector<NoiseBenchRow>& rows);

}  // namespace scattermeter::apps
