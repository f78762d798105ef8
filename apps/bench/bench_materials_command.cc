#include "apps/bench/bench_command.h"
#include "apps/bench/bench_materials.h"

namespace scattermeter::apps {

void add_materials_bench(CLI::App& bench, CommandContext& context,
                         const SharedBenchOptions& common) {
  struct Options {
    MaterialsBenchOptions bench;
    std::string csv;
  };
  const auto options = std::make_shared<Options>();
  CLI::App* command = bench.add_subcommand(
      "materials",
      "Known materials on cube and pyramid under two LEDs, 12-bit raws with noise: is every answer "
      "right, or refused?\n"
      "Wrong: verdict ok, but off by more than 3 stated deviations and by more than 1 % (sigma_s') "
      "or 5 % (sigma_a).\n"
      "materials.csv: material, channel, eta, truth_*, scale_std (relative, told and drawn), "
      "*_per_mm (answer), *_std_per_mm (stated), *_z (error in deviations), reduced_chi2, verdict "
      "(ok, WRONG, refused), reason.");
  command->add_option(
      "--csv", options->csv,
      "list with columns name, channel, eta, sigma_s_prime_per_mm, sigma_a_per_mm (default: four "
      "materials of Jensen et al. 2001)");
  command
      ->add_option("--scale-std", options->bench.scale_stds,
                   "relative deviations of the scale; all materials at each")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  run_if_named(*command, context, [options, common, &context] {
    take_common(*common, context, options->bench);
    const std::vector<MaterialsBenchRow> rows = bench_materials(
        options->csv.empty() ? well_known_materials() : read_materials(options->csv),
        options->bench);
    BenchFiles files(*common, context);
    files.table(materials_bench_table(rows));
    files.csv("materials", materials_bench_csv(rows));
    return 0;
  });
}

}  // namespace scattermeter::apps
