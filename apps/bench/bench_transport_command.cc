#include <memory>

#include "apps/bench/bench_command.h"
#include "apps/bench_transport/bench_transport.h"

namespace scattermeter::apps {

void add_transport_bench(CLI::App& bench, CommandContext& context,
                         const SharedBenchOptions& common) {
  const auto options = std::make_shared<TransportBenchOptions>();
  CLI::App* command = bench.add_subcommand(
      "transport",
      "Speed of the volumetric Monte Carlo: scatterings per second of one core, in a 20 mm cube "
      "or sphere, over the mean free path and the number of triangles.\n"
      "transport.csv: body, triangles, by (planes of the convex body, or rays), mean_free_path_mm, "
      "connections (to the camera), scatterings_per_path, scatterings_per_s_and_core, "
      "connections_per_s_and_core (that reach it), escaped (of what entered), audit_error, "
      "lost_paths.");
  command->add_option("--seconds", options->seconds, "processor time of a row, about")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  run_if_named(*command, context, [options, common, &context] {
    options->seed = common->seed;
    options->progress = context.progress;
    const std::vector<TransportBenchRow> rows = bench_transport(*options);
    BenchFiles files(*common, context);
    files.table(transport_bench_table(rows));
    files.csv("transport", transport_bench_csv(rows));
    return 0;
  });
}

}  // namespace scattermeter::apps
