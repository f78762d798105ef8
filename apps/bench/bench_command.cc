#include <memory>
#include <optional>

#include "apps/bench/bench_commands.h"
#include "apps/bench/bench_noise.h"
#include "apps/bench/bench_rig.h"
#include "apps/instrument/open_objects.h"
#include "apps/simulation/bodies_rig.h"
#include "apps/simulation/plastics_rig.h"
#include "capture/files/pending_file.h"

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
      if (options->scale_std) rig.scene.camera.responsivity_relative_std = *options->scale_std;
      options->bench.seed = common->seed;
      options->bench.progress = context.progress;
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
      options->progress = context.progress;
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

BenchFiles::BenchFiles(const BenchOptions& options, CommandContext& context)
    : out_(options.out), context_(context) {}

void BenchFiles::table(const std::string& text) {
  if (!context_.quiet) context_.out << text;
}

void BenchFiles::csv(const std::string& name, const std::string& text) {
  capture::write_text_file(path(name + ".csv"), text);
}

void BenchFiles::plot(const std::string& name, const Plot& plot) {
  for (const char* extension : {".png", ".svg"}) write_plot(plot, path(name + extension));
}

std::string BenchFiles::path(const std::string& name) {
  const std::string path = out_ + "/" + name;
  if (!context_.quiet) context_.out << "writing " << path << "\n";
  return path;
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
