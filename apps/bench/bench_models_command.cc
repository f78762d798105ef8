#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "apps/bench/bench_command.h"
#include "apps/bench/bench_models.h"
#include "capture/files/pending_file.h"
#include "core/base/input_error.h"
#include "core/mesh/bodies.h"

namespace scattermeter::apps {
namespace {

struct ModelsArguments {
  ModelsBenchOptions bench;  // bodies and models among them
  std::string materials;
  std::vector<std::string> names;
  std::string channels = "G";
  ModelsArguments() { bench.bodies = body_names(); }
};

// The materials that the user asked for.
std::vector<ListedMaterial> wanted_materials(const ModelsArguments& options) {
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
  if (list.empty()) throw InputError("--channels", "the list has none of these channels");
  return list;
}

void declare_options(CLI::App& command, ModelsArguments& a) {
  command.add_option(
      "--materials", a.materials,
      "list with columns name, channel, eta, sigma_s_prime_per_mm, sigma_a_per_mm (default: four "
      "materials of Jensen et al. 2001)");
  command.add_option("--names", a.names, "only these materials");
  command.add_option("--channels", a.channels, "only these channels, letters of RGB")
      ->check([](const std::string& text) {
        return text.empty() || text.find_first_not_of("RGB") != std::string::npos
                   ? "letters of RGB expected, got '" + text + "'"
                   : std::string();
      })
      ->capture_default_str();
  command.add_option("--bodies", a.bench.bodies, "only these bodies")
      ->check(CLI::IsMember(body_names()))
      ->capture_default_str();
  command.add_option("--models", a.bench.models, "only these models")
      ->check(CLI::IsMember(a.bench.models))
      ->capture_default_str();
  command
      .add_option("--paths", a.bench.paths,
                  "light paths of the rendered shots for each light and channel; with few (16000, "
                  "an error of a quarter per patch) the errors of single patches also cause a bias")
      ->check(CLI::Range(std::int64_t{512}, std::int64_t{1'000'000'000'000}))
      ->capture_default_str();
  command
      .add_option("--time-limit", a.bench.time_limit_s,
                  "transport: seconds per material and channel")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command
      .add_option("--scale-std", a.bench.scale_std,
                  "relative standard deviation of the scale: stated, and its error drawn from it")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  add_named_option(command, "--noise", a.bench.noise, {{"on", true}, {"off", false}},
                   "on: samples with the noise of one exposure; off: ideal samples. No rounding");
}

int run_models_bench(ModelsArguments& a, const BenchOptions& common, CommandContext& context) {
  take_common(common, context, a.bench);
  a.bench.after_case = [&common](const std::vector<ModelsBenchRow>& rows) {
    capture::write_text_file(common.out + "/models.csv", models_bench_csv(rows));
  };
  const std::vector<ModelsBenchRow> rows = bench_models(wanted_materials(a), a.bench);
  BenchFiles files(common, context);
  files.table(models_bench_table(rows));
  files.csv("models", models_bench_csv(rows));
  for (const auto& [name, plot] :
       {std::pair("models_sigma_s_prime", models_bench_plot_sigma_s_prime(rows)),
        std::pair("models_sigma_a", models_bench_plot_sigma_a(rows))}) {
    const bool drawable = std::any_of(plot.series.begin(), plot.series.end(),
                                      [](const PlotSeries& s) { return !s.x.empty(); });
    if (drawable) files.plot(name, plot);
  }
  return 0;
}

}  // namespace

void add_models_bench(CLI::App& bench, CommandContext& context, const SharedBenchOptions& common) {
  CLI::App* command = bench.add_subcommand(
      "models",
      "The error of the models: known materials on bodies of known shape, two shots each, rendered "
      "by volumetric Monte Carlo and measured by each model; error against run time.\n"
      "Left out, with the reason: materials whose mean free path exceeds a third of the body's "
      "thickness or is not resolved by the patches, or whose light dies off within a patch.\n"
      "models.csv (updated after each case): body, material, channel, eta, truth_*, model, status "
      "(ok, refused, failed, left out), *_per_mm (estimate), *_std_per_mm (stated), "
      "*_truth_std_per_mm (effect of the Monte Carlo error of the shots on the estimate, from "
      "eight renderings and thus known to 27 %), *_error (estimate / truth - 1), *_z (error over "
      "both deviations), monte_carlo_share (of transport's stated variance), truth_patch_std "
      "(relative, of a patch's light), seconds and cpu_seconds "
      "(of one channel alone, geometry and light included), reason.");
  const auto arguments = std::make_shared<ModelsArguments>();
  declare_options(*command, *arguments);
  run_if_named(*command, context, [arguments, common, &context] {
    return run_models_bench(*arguments, *common, context);
  });
}

}  // namespace scattermeter::apps
