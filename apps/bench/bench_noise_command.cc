#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/bench/bench_command.h"
#include "apps/bench/bench_noise.h"
#include "apps/rig/open_objects.h"
#include "apps/simulation/bodies_rig.h"
#include "apps/simulation/plastics_rig.h"

namespace scattermeter::apps {

void add_noise_bench(CLI::App& bench, CommandContext& context, const SharedBenchOptions& common) {
  struct Options {
    NoiseBenchOptions bench;
    std::string rig;
    std::optional<double> scale_std;
  };
  const auto options = std::make_shared<Options>();
  CLI::App* command = bench.add_subcommand(
      "noise",
      "Noise of the raws alone: many exposures of one scene, each measured jointly.\n"
      "Prints bias, sampled over predicted standard deviation, and how often the 95 % interval "
      "contains the truth.");
  command->add_option("--seeds", options->bench.seeds, "number of exposures")
      ->check(CLI::Range(2, 1'000'000))
      ->capture_default_str();
  command->add_option("--rig", options->rig,
                      "rig file with truth (default: three plastics, cube and pyramid, two LEDs)");
  command
      ->add_option("--scale-std", options->scale_std,
                   "relative standard deviation stated for the scale (default: the rig's; without "
                   "--rig 0, exact)")
      ->check(CLI::NonNegativeNumber);
  run_if_named(*command, context, [options, common, &context] {
    const bool own = options->rig.empty();
    Rig rig = own ? plastics_rig(common->image_width_px.value_or(968)) : read_rig(options->rig);
    const ObjectScenes objects = own ? bodies_scenes(rig) : open_objects(rig);
    if (options->scale_std) rig.scene.camera.responsivity_relative_std = *options->scale_std;
    options->bench.seed = common->seed;
    options->bench.progress = context.progress;
    const std::vector<NoiseBenchRow> rows = bench_noise(rig, objects, options->bench);
    BenchFiles files(*common, context);
    files.table(noise_bench_table(rows));
    files.csv("noise", noise_bench_csv(rows));
    files.plot("noise_pulls", noise_bench_plot(rows));
    return 0;
  });
}

}  // namespace scattermeter::apps
