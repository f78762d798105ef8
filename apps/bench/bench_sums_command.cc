#include <memory>
#include <vector>

#include "apps/bench/bench_command.h"
#include "apps/bench/bench_sums.h"

namespace scattermeter::apps {

void add_sums_bench(CLI::App& bench, CommandContext& context, const SharedBenchOptions& common) {
  const auto options = std::make_shared<SumsBenchOptions>();
  CLI::App* command = bench.add_subcommand(
      "sums",
      "The dipole's sums over many patches, and the derivatives: run time against error, over "
      "tolerance, patches and rows, beside the direct sum of the same run; and a fit of two "
      "coefficients with them, beside the paper's method as one would write it in C++.\n"
      "sums.csv: body, channels, patches, rows, tolerance, tree_s and sum_s (all threads), "
      "tree_one_s and sum_one_s (one thread), direct_ns_per_pair, times_faster (one thread), "
      "median_error and worst_error* (against long double, 64 rows), certified_error, "
      "pairs_per_row, "
      "series_per_row. sums_peers.csv: method, seconds, errors of the answers.");
  command->add_option("--patches", options->patches, "numbers of patches")
      ->check(CLI::Range(100.0, 1e8))
      ->capture_default_str();
  command->add_option("--rows", options->rows, "numbers of rows")
      ->check(CLI::Range(1.0, 1e8))
      ->capture_default_str();
  command->add_option("--tolerances", options->tolerances, "certified relative errors")
      ->check(CLI::Range(1e-5, 0.5))
      ->capture_default_str();
  command
      ->add_option("--loose-tolerance", options->loose_tolerance,
                   "of an image of 130000 rows, 125000 patches and three channels; 0: none")
      ->check(CLI::Range(0.0, 0.5))
      ->capture_default_str();
  command
      ->add_option("--peer-patches", options->peer_patches,
                   "patches of the fits (the dense one holds their square in memory); 0: none")
      ->check(CLI::Range(0, 100000))
      ->capture_default_str();
  command->add_option("--repeats", options->repeats, "runs of which the median is told")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  run_if_named(*command, context, [options, common, &context] {
    options->seed = common->seed;
    const SumsBench result = bench_sums(*options);
    BenchFiles files(*common, context);
    files.table(sums_bench_table(result));
    files.csv("sums", sums_bench_csv(result));
    if (!result.peers.empty()) files.csv("sums_peers", sums_peer_csv(result));
    if (result.rows.empty()) return 0;
    files.plot("sums_error", sums_error_plot(result));
    files.plot("sums_patches", sums_patches_plot(result));
    return 0;
  });
}

}  // namespace scattermeter::apps
