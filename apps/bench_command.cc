#include <memory>
#include <optional>

#include "apps/bench_commands.h"
#include "apps/bench_noise.h"
#include "apps/bench_rig.h"
#include "apps/bodies_rig.h"
#include "apps/plastics_rig.h"

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
      "Prints bias, sampled over predicted deviation, and how often the 95 % interval holds.");
  command->add_option("--seeds", options->bench.seeds, "number of exposures")
      ->check(CLI::Range(2, 1'000'000))
      ->capture_default_str();
  command->add_option("--rig", options->rig,
                      "rig file with truth (default: three plastics, cube and pyramid, two LEDs)");
  command
      ->add_option("--scale-std", options->scale_std,
                   "relative deviation of the scale that the fit is told (default: the rig's; 0, "
                   "exact, without --rig)")
      ->check(CLI::NonNegativeNumber);
  command->callback([options, common, &context] {
    context.chosen = [options, common, &context] {
      const bool own = options->rig.empty();
      Rig rig = own ? plastics_rig(common->image_width_px.value_or(968)) : read_rig(options->rig);
      const ObjectScenes scenes = own ? bodies_scenes(rig) : open_objects(rig);
      if (options->scale_std) rig.camera.responsivity_relative_std = *options->scale_std;
      options->bench.seed = common->seed;
      options->bench.quiet = context.quiet;
      const std::vector<NoiseBenchRow> rows = bench_noise(rig, scenes, options->bench);
      BenchFiles files(*common, context);
      files.table(noise_bench_table(rows));
      files.csv("noise", noise_bench_csv(rows));
      files.plot("noise_pulls", noise_bench_plot(rows));
      return 0;
    };
  });
}

void add_rig_bench(CLI::App& bench, CommandContext& context, const SharedBenchOptions& common) {
  const auto options = std::make_shared<RigBenchOptions>();
  CLI::App* command = bench.add_subcommand(
      "rig",
      "Errors of the rig: LED places and powers and pose points drawn from what the rig is told of "
      "them.\nPrints how much single shots vary, and error and coverage of the joint answer.");
  command->add_option("--draws", options->draws, "number of rigs drawn")
      ->check(CLI::Range(2, 1'000'000))
      ->capture_default_str();
  command->callback([options, common, &context] {
    context.chosen = [options, common, &context] {
      options->seed = common->seed;
      options->image_width_px = common->image_width_px.value_or(options->image_width_px);
      options->quiet = context.quiet;
      const RigBench result = bench_rig(*options);
      BenchFiles files(*common, context);
      files.table(rig_bench_table(result));
      files.csv("rig", rig_bench_csv(result));
      files.csv("rig_single_shots", single_shot_csv(result));
      files.plot("rig_pulls", rig_bench_plot(result));
      return 0;
    };
  });
}

void add_bench_command(CLI::App& app, CommandContext& context) {
  const auto common = std::make_shared<BenchOptions>();
  CLI::App* bench = app.add_subcommand(
      "bench",
      "Measure the program itself on simulated shots whose truth is known.\n"
      "Prints a table; writes CSV and pictures (PNG, SVG; drawn by gnuplot) to OUT.");
  bench->require_subcommand(1);
  bench->add_option("--out", common->out, "folder for tables and pictures")->capture_default_str();
  bench->add_option("--seed", common->seed, "of all that is drawn")->capture_default_str();
  bench
      ->add_option("--image-width", common->image_width_px,
                   "width in px of the simulated frames of a rig made in code (default: 968; paper "
                   "and patches: 3872)")
      ->check(CLI::Range(240, 3872));
  add_noise_bench(*bench, context, common);
  add_rig_bench(*bench, context, common);
  add_plan_bench(*bench, context, common);
  add_paper_bench(*bench, context, common);
  add_patches_bench(*bench, context, common);
  add_materials_bench(*bench, context, common);
  add_models_bench(*bench, context, common);
  add_transport_bench(*bench, context, common);
  add_shots_bench(*bench, context, common);
  add_sums_bench(*bench, context, common);
}

}  // namespace scattermeter::apps
