#include <memory>
#include <vector>

#include "apps/bench/bench_command.h"
#include "apps/bench/bench_shots.h"

namespace scattermeter::apps {

void add_shots_bench(CLI::App& bench, CommandContext& context, const SharedBenchOptions& common) {
  const auto options = std::make_shared<ShotsBenchOptions>();
  CLI::App* command = bench.add_subcommand(
      "shots",
      "Measuring one plastic from more and more shots, each under an LED of its own: run time and "
      "errors of the answers.\n"
      "shots.csv: shots, seconds (geometry to answer, frames in memory), *_error (the worst of "
      "three channels, answer / truth - 1), *_std (the largest stated, of the truth), stages.");
  command->add_option("--shots", options->shots, "numbers of shots")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  command->add_option("--repeats", options->repeats, "runs of which the fastest is told")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  run_if_named(*command, context, [options, common, &context] {
    options->progress = context.progress;
    options->image_width_px = common->image_width_px.value_or(options->image_width_px);
    const std::vector<ShotsBenchRow> rows = bench_shots(*options);
    BenchFiles files(*common, context);
    files.table(shots_bench_table(rows));
    files.csv("shots", shots_bench_csv(rows));
    files.plot("shots", shots_bench_plot(rows));
    return 0;
  });
}

}  // namespace scattermeter::apps
