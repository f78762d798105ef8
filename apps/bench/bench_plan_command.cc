#include <memory>

#include "apps/bench/bench_command.h"
#include "apps/bench/bench_plan.h"

namespace scattermeter::apps {

void add_plan_bench(CLI::App& bench, CommandContext& context, const SharedBenchOptions& common) {
  const auto options = std::make_shared<PlanBenchOptions>();
  CLI::App* command = bench.add_subcommand(
      "plan",
      "The forecast of `plan` against what measuring then states: rigs drawn at random (bodies, "
      "materials, LEDs, how well all is known), planned, shot with noise, measured.\n"
      "Prints both standard deviations and their ratio.");
  command->add_option("--rigs", options->rigs, "number of rigs drawn")
      ->check(CLI::Range(1, 100'000))
      ->capture_default_str();
  run_if_named(*command, context, [options, common, &context] {
    take_common(*common, context, *options);
    const std::vector<PlanBenchRow> rows = bench_plan(*options);
    BenchFiles files(*common, context);
    files.table(plan_bench_table(rows));
    files.csv("plan", plan_bench_csv(rows));
    if (plan_bench_ratios(rows).n > 0) files.plot("plan_ratios", plan_bench_plot(rows));
    return 0;
  });
}

}  // namespace scattermeter::apps
