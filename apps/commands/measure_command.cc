#include <memory>
#include <ostream>

#include "apps/commands/commands.h"
#include "apps/instrument/measure.h"
#include "apps/report/result_page.h"
#include "apps/report/result_table.h"
#include "apps/results/result_json.h"
#include "capture/files/pending_file.h"

namespace scattermeter::apps {

void add_measure_command(CLI::App& app, CommandContext& context) {
  struct Options {
    std::string shots, rig, out = "result", model = "auto";
    double patch_mm = 0.0;
    double time_limit_s = 50.0;
    std::int64_t paths = EstimateOptions{}.paths;
    std::vector<std::string> materials;
    std::string channels;
    bool no_cache = false;
  };
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "measure",
      "Measure the materials in a folder of raw shots.\n"
      "Prints one line per material and colour channel: sigma_s' (reduced scattering) and sigma_a "
      "(absorption) in 1/mm with standard deviations, and a verdict; writes OUT/result.json and, "
      "to look at, "
      "OUT/result.html.\n"
      "Exit status: 0 all measured, 1 at least one value refused, 2 bad input.");
  command->add_option("SHOTS", options->shots, "folder of the raw files")->required();
  command
      ->add_option("--rig", options->rig, "rig file: camera, pose, objects, lights, shots (YAML)")
      ->required();
  command->add_option("--out", options->out, "folder for result.json and result.html")
      ->capture_default_str();
  std::vector<std::string> models;
  std::string of_models;
  for (const Estimator& e : estimators()) {
    models.emplace_back(e.name);
    of_models += (of_models.empty() ? "" : "; ") + std::string(e.name) + ": " + e.description;
  }
  command->add_option("--model", options->model, of_models)
      ->check(CLI::IsMember(models))
      ->capture_default_str();
  command
      ->add_option("--patch-size", options->patch_mm,
                   "edge of the surface patches in mm (default: the rig's, or object size / 50)")
      ->check(CLI::PositiveNumber);
  command
      ->add_option("--time-limit", options->time_limit_s,
                   "seconds that transport may take per material and channel; where they run out, "
                   "the digits depend on the machine's speed")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command
      ->add_option("--paths", options->paths,
                   "of transport's last step, at most, for each light and view; where they run out "
                   "first, the digits are the same on any machine")
      ->check(CLI::Range(std::int64_t{300'000}, std::int64_t{1'000'000'000'000}))
      ->capture_default_str();
  command->add_option("--material", options->materials,
                      "only this material (may be given several times): shots of others are not "
                      "opened");
  command
      ->add_option("--channels", options->channels,
                   "only these, letters of RGB (default: all three)")
      ->check(CLI::IsMember({"R", "G", "B", "RG", "RB", "GB", "RGB"}));
  command->add_flag("--no-cache", options->no_cache,
                    "decode every shot and keep none (else what was decoded stays in OUT/cache, "
                    "and is used again while files, camera, pose, lens, meshes and patches are the "
                    "same)");
  command->callback([options, &context] {
    context.chosen = [options, &context] {
      MeasureOptions measure_options;
      measure_options.estimate.model = options->model;
      measure_options.estimate.time_limit_s = options->time_limit_s;
      measure_options.estimate.paths = options->paths;
      measure_options.estimate.keep_rows = true;
      measure_options.materials = options->materials;
      measure_options.estimate.channels = options->channels;
      if (!options->no_cache) measure_options.cache_folder = options->out + "/cache";
      if (options->patch_mm > 0.0) measure_options.patch_size_mm = options->patch_mm;
      const Measurement measurement =
          measure(read_rig(options->rig), options->shots, measure_options, context.progress);
      const std::string path = options->out + "/result.json";
      const std::string page = options->out + "/result.html";
      capture::write_text_file(path, result_json(measurement, context.command_line));
      capture::write_text_file(page, result_page(measurement, context.command_line));
      for (const std::string& note : measurement.notes) context.err << "note: " << note << "\n";
      if (!context.quiet) {
        context.out << result_table(measurement) << "written: " << path << ", " << page << "\n";
      }
      return measurement.any_refused() ? 1 : 0;
    };
  });
}

}  // namespace scattermeter::apps
