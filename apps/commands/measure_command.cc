#include <charconv>
#include <cstdint>
#include <memory>
#include <optional>
#include <ostream>
#include <string>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "apps/commands/commands.h"
#include "apps/instrument/measure.h"
#include "apps/pages/result_page.h"
#include "apps/report/result_table.h"
#include "apps/results/result_json.h"
#include "capture/files/file_kind.h"
#include "capture/files/pending_file.h"

namespace scattermeter::apps {
namespace {

struct MeasureArguments {
  std::string shots, rig, out = "result", atlas;
  MeasureOptions options;
  bool no_cache = false;
  MeasureArguments() { options.estimate.model = "auto"; }
};

// Of --precision. Throws CLI::ValidationError.
std::optional<PrecisionGoal> goal_of(const std::string& text) {
  constexpr double kSigma_a = 5.0;  // of that of sigma_s'
  if (text == "full") return std::nullopt;
  double percent = 0.0;
  const char* const end = text.data() + text.size();
  const auto [read, error] = std::from_chars(text.data(), end, percent);
  if (error != std::errc() || read != end || !(percent > 0.0)) {
    throw CLI::ValidationError("--precision", "expected full or a positive number, got " + text);
  }
  return PrecisionGoal{0.01 * percent, 0.01 * kSigma_a * percent};
}

void declare_options(CLI::App& command, MeasureArguments& a) {
  EstimateOptions& estimate = a.options.estimate;
  command.add_option("SHOTS", a.shots, "folder of the raw files")->required();
  command.add_option("--rig", a.rig, "rig file: camera, pose, objects, lights, shots (YAML)")
      ->required();
  command.add_option("--out", a.out, "folder for result.json and result.html")
      ->capture_default_str();
  std::vector<std::string> models, descriptions;
  for (const Estimator& e : estimators()) {
    models.emplace_back(e.name);
    descriptions.push_back(fmt::format("{}: {}", e.name, e.description));
  }
  command.add_option("--model", estimate.model, fmt::format("{}", fmt::join(descriptions, "; ")))
      ->check(CLI::IsMember(models))
      ->capture_default_str();
  command
      .add_option("--patch-size", a.options.patch_size_mm,
                  "edge of the surface patches in mm (default: the rig's, or object size / 50)")
      ->check(CLI::PositiveNumber);
  command
      .add_option("--time-limit", estimate.time_limit_s,
                  "transport: seconds per material and channel (half as many again where only the "
                  "last paths are missing); if they run out, the digits depend on the speed of the "
                  "machine")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command
      .add_option("--paths", estimate.paths,
                  "transport: most light paths of the last step, for each light and view; if they "
                  "run out first, the digits are the same on any machine")
      ->check(CLI::Range(std::int64_t{300'000}, std::int64_t{1'000'000'000'000}))
      ->capture_default_str();
  command
      .add_option_function<std::string>(
          "--precision", [&a](const std::string& text) { a.options.goal = goal_of(text); },
          "full: all patches; a number: the standard deviation that suffices, in per cent of "
          "sigma_s' (of sigma_a, five times as much): where the dipole reaches it with fewer "
          "patches, evenly spread, the others are skipped, unless something casts doubt on the "
          "result")
      ->type_name("full|PERCENT")
      ->default_str("full");
  command.add_option("--material", a.options.materials,
                     "only this material (may be repeated); shots of others are not opened");
  command
      .add_option("--channels", estimate.channels,
                  "only these, letters of RGB (default: all three)")
      ->check(CLI::IsMember({"R", "G", "B", "RG", "RB", "GB", "RGB"}));
  command.add_flag("--no-cache", a.no_cache,
                   "decode every shot anew and keep none (by default decoded shots are kept in "
                   "OUT/cache and used again while files, camera, pose, lens, meshes and patches "
                   "are the same)");
  command.add_option(
      "--atlas", a.atlas,
      "folder of what depends on the jig alone, its views, the dipole's weights of light (at most "
      "1 GB each) and the paths of transport, which all materials and channels use again; several "
      "programs may share it (default: OUT/atlas; with --no-cache they are not kept)");
}

int run_measure(const MeasureArguments& a, CommandContext& context) {
  require_results_folder(a.out, a.shots);
  if (capture::is_there(a.atlas) && !capture::is_folder(a.atlas)) {
    throw InputError("--atlas", "is a file, a folder is needed, got " + a.atlas);
  }
  MeasureOptions options = a.options;
  options.estimate.keep_rows = true;
  if (!a.no_cache) options.cache_folder = a.out + "/cache";
  options.atlas_folder = a.atlas.empty() && !a.no_cache ? a.out + "/atlas" : a.atlas;
  const Measurement measurement = measure(read_rig(a.rig), a.shots, options, context.progress);
  const std::string path = a.out + "/result.json";
  const std::string page = a.out + "/result.html";
  capture::write_text_file(path, result_json(measurement, context.command_line));
  capture::write_text_file(page, result_page(measurement, context.command_line));
  for (const std::string& note : measurement.notes) context.err << "note: " << note << "\n";
  if (!context.quiet) {
    context.out << result_table(measurement) << "written: " << path << ", " << page << "\n";
  }
  return measurement.any_refused() ? 1 : 0;
}

}  // namespace

void add_measure_command(CLI::App& app, CommandContext& context) {
  CLI::App* command = app.add_subcommand(
      "measure",
      "Measure the materials in a folder of raw shots.\n"
      "Prints one line per material and colour channel: sigma_s' (reduced scattering) and sigma_a "
      "(absorption) in 1/mm with standard deviations, and a verdict. Writes OUT/result.json and a "
      "page to look at, OUT/result.html.\n"
      "Exit status: 0 all measured, 1 at least one value refused, 2 bad input.");
  const auto arguments = std::make_shared<MeasureArguments>();
  declare_options(*command, *arguments);
  run_if_named(*command, context,
               [arguments, &context] { return run_measure(*arguments, context); });
}

}  // namespace scattermeter::apps
