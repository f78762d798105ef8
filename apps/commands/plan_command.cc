#include <cmath>
#include <memory>
#include <optional>
#include <ostream>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/core.h>

#include "apps/commands/commands.h"
#include "apps/instrument/rig_inputs.h"
#include "apps/pages/led_map_plot.h"
#include "apps/pages/plan_page.h"
#include "apps/planning/plan.h"
#include "apps/report/plan_json.h"
#include "apps/report/plan_table.h"
#include "capture/files/pending_file.h"
#include "core/base/input_error.h"

namespace scattermeter::apps {
namespace {

std::optional<ExpectedRange> range_of(const std::vector<double>& values, const char* option,
                                      bool may_be_zero) {
  if (values.empty()) return std::nullopt;
  const ExpectedRange range{values.front(), values.back()};
  if (!(may_be_zero ? range.low >= 0.0 : range.low > 0.0) || !(range.high >= range.low) ||
      !std::isfinite(range.high)) {
    throw InputError(
        option, fmt::format("expected a {2} number and one that is not smaller, got {0} and {1}",
                            range.low, range.high, may_be_zero ? "non-negative" : "positive"));
  }
  return range;
}

// Writes two maps for each material and object and adds their paths to `written`.
void write_maps(const Plan& plan, const std::string& folder, std::vector<std::string>& written,
                CommandContext& context) {
  int maps = 0;
  for (const SuggestedShots& shots : plan.suggested_shots) {
    for (const LedMap& map : shots.maps) {
      for (const bool joined : {true, false}) {
        const std::string path = fmt::format("{}/plan_map_{}.png", folder, ++maps);
        try {
          write_plot(led_map_plot(shots, map, joined).plot, path);
          written.push_back(path);
        } catch (const std::invalid_argument&) {
          // Nothing to draw: no position has a forecast.
        } catch (const InputError& e) {
          context.err << "note: " << e.what() << "\n";
        }
      }
    }
  }
}

}  // namespace

void add_plan_command(CLI::App& app, CommandContext& context) {
  struct Options {
    std::string rig, out;
    std::vector<double> sigma_s, sigma_a;
    std::optional<double> patch_mm;
    bool fast = false;
  };
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "plan",
      "Predict the uncertainty of what a rig's shots will measure, before they are taken.\n"
      "From the rig, its meshes and the expected materials (the rig's truth.materials, or the "
      "ranges below): standard deviations of sigma_s' and sigma_a as `measure` will state them, "
      "with their causes; clipped or dark shots and suggested exposure times; what would help "
      "most. "
      "With --out: plan.json, plan.html, and maps of the standard deviation of sigma_a over LED "
      "positions (plan_map_1.png ...).\n"
      "Exit status: 0 all would be measured, 1 at least one value would be refused, 2 bad input.");
  command->add_option("RIG", options->rig, "rig file (YAML)")->required();
  command->add_option("--out", options->out, "folder for plan.json, plan.html and maps");
  command
      ->add_option("--sigma-s-prime", options->sigma_s,
                   "least and largest expected sigma_s', 1/mm, for all materials and channels, "
                   "instead of the rig's")
      ->expected(2);
  command->add_option("--sigma-a", options->sigma_a, "the same for sigma_a")->expected(2);
  command
      ->add_option("--patch-size", options->patch_mm,
                   "edge of the surface patches in mm, as for measure")
      ->check(CLI::PositiveNumber);
  command->add_flag("--fast", options->fast, "without maps and suggestions for other shots");
  run_if_named(*command, context, [options, &context] {
    if (!options->out.empty()) capture::require_output_folder(options->out);
    PlanOptions plan_options;
    plan_options.sigma_s_prime_per_mm = range_of(options->sigma_s, "--sigma-s-prime", false);
    plan_options.sigma_a_per_mm = range_of(options->sigma_a, "--sigma-a", true);
    plan_options.patch_size_mm = options->patch_mm;
    plan_options.suggested_shots = !options->fast;
    const Plan made = plan(read_rig(options->rig), plan_options, context.progress);
    if (!context.quiet) context.out << plan_table(made);
    if (options->out.empty()) return made.any_refused() ? 1 : 0;
    std::vector<std::string> written = {options->out + "/plan.json", options->out + "/plan.html"};
    capture::write_text_file(written[0], plan_json(made, context.command_line));
    capture::write_text_file(written[1], plan_page(made, context.command_line));
    write_maps(made, options->out, written, context);
    if (!context.quiet) {
      context.out << "written:";
      for (const std::string& path : written) context.out << " " << path;
      context.out << "\n";
    }
    return made.any_refused() ? 1 : 0;
  });
}

}  // namespace scattermeter::apps
