#include "apps/bench/bench_noise.h"

#include <stdexcept>

#include <fmt/core.h>

#include "apps/bench/pull_plot.h"
#include "apps/instrument/instrument.h"
#include "apps/report/csv.h"
#include "apps/report/text_table.h"
#include "apps/simulation/virtual_shots.h"
#include "core/base/progress.h"
#include "core/camera/channel_index.h"

namespace scattermeter::apps {
namespace {

// Estimates of one material and channel.
struct NoiseEstimates {
  std::vector<DrawnEstimate> s, a;
  double refused = 0;
};

struct NamedStatistics {
  const char* name;
  const EstimateStatistics& statistics;
};
std::array<NamedStatistics, 2> quantities_of(const NoiseBenchRow& row) {
  return {{{"sigma_s'", row.sigma_s_prime_per_mm}, {"sigma_a", row.sigma_a_per_mm}}};
}

}  // namespace

std::vector<NoiseBenchRow> bench_noise(const Rig& rig, const ObjectScenes& objects,
                                       const NoiseBenchOptions& options) {
  if (options.seeds < 2) {
    throw std::invalid_argument("bench_noise: at least two seeds expected, got " +
                                std::to_string(options.seeds));
  }
  const VirtualShots shots(rig, objects, {.noise = true, .progress = options.progress});
  Instrument instrument(rig, objects, {});
  std::vector<NoiseEstimates> estimates;
  std::vector<NoiseBenchRow> rows;
  ProgressStage stage(options.progress, "seeds", static_cast<std::size_t>(options.seeds));
  for (int i = 0; i < options.seeds; ++i) {
    const std::uint64_t seed = options.seed + static_cast<std::uint64_t>(i);
    const Measurement m = instrument.measure(shots.source(seed));
    estimates.resize(m.results.size());
    rows.resize(m.results.size());
    for (std::size_t r = 0; r < m.results.size(); ++r) {
      const ChannelResult& result = m.results[r];
      rows[r].material = result.material;
      rows[r].channel = result.channel;
      if (result.refused()) {
        estimates[r].refused += 1.0;
        continue;
      }
      const NoiseStd noise = noise_std(result.estimate);
      estimates[r].s.push_back({result.estimate.sigma_s_prime_per_mm, noise.sigma_s_prime_per_mm});
      estimates[r].a.push_back({result.estimate.sigma_a_per_mm, noise.sigma_a_per_mm});
    }
    stage.step();
  }
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const std::size_t channel = channel_index(rows[r].channel);
    const Medium& truth = rig.truth.materials.at(rows[r].material)[channel];
    rows[r].sigma_s_prime_per_mm = estimate_statistics(truth.sigma_s_prime_per_mm, estimates[r].s);
    rows[r].sigma_a_per_mm = estimate_statistics(truth.sigma_a_per_mm, estimates[r].a);
    rows[r].refused = estimates[r].refused / options.seeds;
  }
  return rows;
}

std::string noise_bench_table(const std::vector<NoiseBenchRow>& rows) {
  using Align = TextTable::Align;
  TextTable table({{"material", Align::kLeft},
                   {"ch", Align::kLeft},
                   {"[1/mm]", Align::kLeft},
                   {"truth"},
                   {"mean"},
                   {"bias %"},
                   {"sampled std"},
                   {"predicted"},
                   {"ratio"},
                   {"RMSE/noise"},
                   {"in 95 %"},
                   {"refused"}});
  for (const NoiseBenchRow& row : rows) {
    for (const auto& [name, s] : quantities_of(row)) {
      table.add_row(
          {row.material, std::string(1, row.channel), name, fmt::format("{:.4g}", s.truth),
           fmt::format("{:.6g}", s.mean),
           fmt::format("{:+.3f} ± {:.3f}", 100.0 * s.bias_relative, 100.0 * s.bias_relative_std),
           fmt::format("{:.2e}", s.sampled_std), fmt::format("{:.2e}", s.predicted_std),
           fmt::format("{:.2f}", s.std_ratio), fmt::format("{:.2f}", s.rmse_over_noise_std),
           fmt::format("{:.0f} %", 100.0 * s.coverage95),
           fmt::format("{:.0f} %", 100.0 * row.refused)});
    }
  }
  return table.text();
}

std::string noise_bench_csv(const std::vector<NoiseBenchRow>& rows) {
  Csv csv({"material", "channel", "quantity", "answered", "truth_per_mm", "mean_per_mm",
           "bias_relative", "bias_relative_std", "sampled_std_per_mm", "predicted_std_per_mm",
           "std_ratio", "rmse_per_mm", "rmse_over_noise_std", "coverage95", "refused"});
  for (const NoiseBenchRow& row : rows) {
    for (const auto& [name, s] : quantities_of(row)) {
      csv.add_row({row.material, std::string(1, row.channel), name, std::to_string(s.n),
                   csv_number(s.truth), csv_number(s.mean), csv_number(s.bias_relative),
                   csv_number(s.bias_relative_std), csv_number(s.sampled_std),
                   csv_number(s.predicted_std), csv_number(s.std_ratio), csv_number(s.rmse),
                   csv_number(s.rmse_over_noise_std), csv_number(s.coverage95),
                   csv_number(row.refused)});
    }
  }
  return csv.text();
}

Plot noise_bench_plot(const std::vector<NoiseBenchRow>& rows) {
  std::vector<double> s, a;
  for (const NoiseBenchRow& row : rows) {
    const std::vector<double>& from_s = row.sigma_s_prime_per_mm.pulls;
    const std::vector<double>& from_a = row.sigma_a_per_mm.pulls;
    s.insert(s.end(), from_s.begin(), from_s.end());
    a.insert(a.end(), from_a.begin(), from_a.end());
  }
  return pull_plot("Noise drawn, rig exact: errors over predicted deviations",
                   {{"sigma_s'", s}, {"sigma_a", a}});
}

}  // namespace scattermeter::apps
