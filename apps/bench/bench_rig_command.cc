#include <memory>

#include "apps/bench/bench_command.h"
#include "apps/bench/bench_rig.h"

namespace scattermeter::apps {

void add_rig_bench(CLI::App& bench, CommandContext& context, const SharedBenchOptions& common) {
  const auto options = std::make_shared<RigBenchOptions>();
  CLI::App* command = bench.add_subcommand(
      "rig",
      "Errors of the rig: LED places and powers and pose points drawn from what the rig is told of "
      "them.\nPrints how much single shots vary, and error and coverage of the joint answer.");
  command->add_option("--draws", options->draws, "number of rigs drawn")
      ->check(CLI::Range(2, 1'000'000))
      ->capture_default_str();
  run_if_named(*command, context, [options, common, &context] {
    take_common(*common, context, *options);
    const RigBench result = bench_rig(*options);
    BenchFiles files(*common, context);
    files.table(rig_bench_table(result));
    files.csv("rig", rig_bench_csv(result));
    files.csv("rig_single_shots", single_shot_csv(result));
    files.plot("rig_pulls", rig_bench_plot(result));
    return 0;
  });
}

}  // namespace scattermeter::apps
