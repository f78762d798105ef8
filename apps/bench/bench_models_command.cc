#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "apps/bench/bench_commands.h"
#include "apps/bench/bench_models.h"
#include "capture/files/pending_file.h"
#include "core/base/input_error.h"
#include "core/mesh/bodies.h"

namespace scattermeter::apps {
namespace {

struct Options {
  ModelsBenchOptions bench;
  std::string materials;
  std::vector<std::string> names;
  std::string channels = "G";
  std::vector<std::string> bodies = body_names();
  std::vector<std::string> models = {"paper", "dipole", "transport"};
};

// The materials that the user asked for.
std::vector<ListedMaterial> wanted_materials(const Options& options) {
  std::vector<ListedMaterial> list =
      options.materials.empty() ? well_known_materials() : read_materials(options.materials);
  for (const std::string& name : options.names) {
    if (std::none_of(list.begin(), list.end(),
                     [&](const ListedMaterial& m) { return m.name == name; })) {
      throw InputError("--names", "no material '" + name + "' in the list");
    }
  }
  std::erase_if(list, [&](const ListedMaterial& m) {
    return options.channels.find(m.channel) == std::string::npos ||
           (!options.names.empty() &&
            std::find(options.names.begin(), options.names.end(), m.name) == options.names.end());
  });
  if (list.empty()) throw InputError("--channels", "the materials have no channel of these");
  return list;
}

}  // namespace

void add_models_bench(CLI::App& bench, CommandContext& context, const SharedBenchOptions& common) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = bench.add_subcommand(
      "models",
      "The error of the models: known materials on bodies of known shape, two shots each, rendered "
      "by volume Monte Carlo and measured by each model; error against run time.\n"
      "Left out, with the reason: materials whose mean free path is over a third of the body's "
      "thickness or is not resolved by the patches, or whose light dies off within a patch.\n"
      "models.csv (kept up to date from case to case): body, material, channel, eta, truth_*, "
      "model, status (ok, refused, failed, left out), *_per_mm (answer), *_std_per_mm (stated), "
      "*_truth_std_per_mm (what the Monte Carlo error of the shots is worth in an answer: from "
      "eight renderings, so itself known to 27 %), *_error (answer / truth - 1), *_z (error over "
      "both deviations), truth_patch_std (relative, of a patch's light), seconds and cpu_seconds "
      "(of one channel alone, geometry and light included), reason.");
  command->add_option(
      "--materials", options->materials,
      "list with columns name, channel, eta, sigma_s_prime_per_mm, sigma_a_per_mm (default: four "
      "materials of Jensen et al. 2001)");
  command->add_option("--names", options->names, "of these materials only");
  command->add_option("--channels", options->channels, "of the materials: R, G, B together")
      ->check([](const std::string& text) {
        return text.empty() || text.find_first_not_of("RGB") != std::string::npos
                   ? "R, G, B expected, got '" + text + "'"
                   : std::string();
      })
      ->capture_default_str();
  command->add_option("--bodies", options->bodies, "on these")
      ->check(CLI::IsMember(body_names()))
      ->capture_default_str();
  command->add_option("--models", options->models, "by these")
      ->check(CLI::IsMember(options->models))
      ->capture_default_str();
  command
      ->add_option(
          "--paths", options->bench.paths,
          "of the shots' Monte Carlo, for each light and channel; with few (16000, where a "
          "patch errs by a quarter) what single patches err by is a bias as well")
      ->check(CLI::Range(std::int64_t{512}, std::int64_t{1'000'000'000'000}))
      ->capture_default_str();
  command
      ->add_option("--time-limit", options->bench.time_limit_s,
                   "of the search of transport, s per material and channel")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command
      ->add_option("--scale-std", options->bench.scale_std,
                   "relative deviation of the scale: told, and its error drawn from it")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command
      ->add_option("--noise", options->bench.noise,
                   "on: samples with the noise of one exposure; off: ideal samples. No rounding")
      ->transform(CLI::Transformer(std::map<std::string, bool>{{"on", true}, {"off", false}}));
  command->callback([options, common, &context] {
    context.chosen = [options, common, &context] {
      ModelsBenchOptions& bench_options = options->bench;
      bench_options.bodies = options->bodies;
      bench_options.models = options->models;
      bench_options.image_width_px = common->image_width_px.value_or(bench_options.image_width_px);
      bench_options.seed = common->seed;
      bench_options.progress = context.progress;
      bench_options.after_case = [&common](const std::vector<ModelsBenchRow>& rows) {
        capture::write_text_file(common->out + "/models.csv", models_bench_csv(rows));
      };
      const std::vector<ModelsBenchRow> rows =
          bench_models(wanted_materials(*options), bench_options);
      BenchFiles files(*common, context);
      files.table(models_bench_table(rows));
      files.csv("models", models_bench_csv(rows));
      const Plot sigma_s = models_bench_plot_sigma_s_prime(rows);
      const Plot sigma_a = models_bench_plot_sigma_a(rows);
      const auto drawable = [](const Plot& plot) {
        return std::any_of(plot.series.begin(), plot.series.end(),
                           [](const PlotSeries& s) { return !s.x.empty(); });
      };
      if (drawable(sigma_s)) files.plot("models_sigma_s_prime", sigma_s);
      if (drawable(sigma_a)) files.plot("models_sigma_a", sigma_a);
      return 0;
    };
  });
}

}  // namespace scattermeter::apps
