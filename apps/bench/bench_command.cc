#include "apps/bench/bench_command.h"

#include <memory>
#include <ostream>

#include "capture/files/pending_file.h"

namespace scattermeter::apps {

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
      "Test the program itself on simulated shots with known truth.\n"
      "Prints a table; writes CSV files and plots (PNG, SVG; drawn by gnuplot) to OUT.");
  bench->require_subcommand(1);
  bench->add_option("--out", common->out, "folder for tables and plots")->capture_default_str();
  bench->add_option("--seed", common->seed, "seed of all random numbers")->capture_default_str();
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
  add_atlas_bench(*bench, context, common);
  add_shots_bench(*bench, context, common);
  add_deviations_bench(*bench, context, common);
  add_silicones_bench(*bench, context, common);
  add_sums_bench(*bench, context, common);
}

}  // namespace scattermeter::apps
