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
#include "apps/planning/plan.h"
#include "apps/report/led_map_plot.h"
#include "apps/report/plan_json.h"
#include "apps/report/plan_page.h"
#include "apps/report/plan_table.h"
#include "capture/files/pending_file.h"
#include "core/base/input_error.h"

namespace scattermeter::apps {
namespace {

std::optional<ExpectedRange> range_of(const std::vector<double>& values, const char* option,
                                      bool may_be_0) {
  if (values.empty()) return std::nullopt;
  const ExpectedRange range{values.front(), values.back()};
  if (!(may_be_0 ? range.low >= 0.0 : range.low > 0.0) || !(range.high >= range.low) ||
      !std::isfinite(range.high)) {
    throw InputError(
        option, fmt::format("{} {}: a range from a {} number to a larger one expected", range.low,
                            range.high, may_be_0 ? "non-negative" : "positive"));
  }
  return range;
}

}  // namespace

void add_plan_command(CLI::App& app, CommandContext& context) {
  struct Options {
    std::string rig, out;
    std::vector<double> sigma_s, sigma_a;
    double patch_mm = 0.0;
    bool fast = false;
  };
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "plan",
      "Tell what a rig's shots will be able to tell, before they are taken.\n"
      "From the rig, its meshes and the materials to expect (the rig's truth.materials, or the "
      "ranges below): standard deviations of sigma_s' and sigma_a as `measure` will state them, "
      "with their causes; clipped or dark shots and the times to take; what would help most. With "
      "--out: plan.json, plan.html, and maps of sigma_a's deviation over LED positions "
      "(plan_map_1.png ...).\n"
      "Exit status: 0 all would be measured, 1 at least one value would be refused, 2 bad input.");
  command->add_option("RIG", options->rig, "rig file (YAML)")->required();
  command->add_option("--out", options->out, "folder for plan.json, plan.html and maps");
  command
      ->add_option("--sigma-s-prime", options->sigma_s,
                   "least and largest sigma_s' to expect, 1/mm, of all materials and channels, in "
                   "place of the rig's")
      ->expected(2);
  command->add_option("--sigma-a", options->sigma_a, "the same of sigma_a")->expected(2);
  command
      ->add_option("--patch-size", options->patch_mm,
                   "edge of the surface patches in mm, as of measure")
      ->check(CLI::PositiveNumber);
  command->add_flag("--fast", options->fast, "without maps and what other shots would add");
  command->callback([options, &context] {
    context.chosen = [options, &context] {
      PlanOptions plan_options;
      plan_options.sigma_s_prime_per_mm = range_of(options->sigma_s, "--sigma-s-prime", false);
      plan_options.sigma_a_per_mm = range_of(options->sigma_a, "--sigma-a", true);
      if (options->patch_mm > 0.0) plan_options.patch_size_mm = options->patch_mm;
      plan_options.other_shots = !options->fast;
      const Plan made = plan(read_rig(options->rig), plan_options, context.progress);
      if (!context.quiet) context.out << plan_table(made);
      if (options->out.empty()) return made.any_refused() ? 1 : 0;
      std::vector<std::string> written = {options->out + "/plan.json", options->out + "/plan.html"};
      capture::write_text_file(written[0], plan_json(made, context.command_line));
      capture::write_text_file(written[1], plan_page(made, context.command_line));
      int maps = 0;
      for (const OtherShots& o : made.other_shots) {
        for (const LedMap& map : o.maps) {
          for (const bool joined : {true, false}) {
            const std::string path = fmt::format("{}/plan_map_{}.png", options->out, ++maps);
            try {
              write_plot(led_map_plot(o, map, joined).plot, path);
              written.push_back(path);
            } catch (const std::invalid_argument&) {
              // No place has an answer: there is nothing to draw.
            } catch (const InputError& e) {
              context.err << "note: " << e.what() << "\n";
            }
          }
        }
      }
      if (!context.quiet) {
        context.out << "written:";
        for (const std::string& path : written) context.out << " " << path;
        context.out << "\n";
      }
      return made.any_refused() ? 1 : 0;
    };
  });
}

}  // namespace scattermeter::apps
