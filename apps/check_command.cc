#include <memory>
#include <ostream>

#include "apps/check.h"
#include "apps/commands.h"

namespace scattermeter::apps {

void add_check_command(CLI::App& app, CommandContext& context) {
  struct Options {
    std::string shots, rig;
  };
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "check",
      "Check the rig against its shots: pose, exposure, noise, camera settings.\n"
      "Prints every residual with its limit and what to do where it fails.\n"
      "Exit status: 0 all passed, 1 at least one failed, 2 bad input.");
  command->add_option("SHOTS", options->shots, "folder of the raw files")->required();
  command->add_option("--rig", options->rig, "rig file (YAML)")->required();
  command->callback([options, &context] {
    context.chosen = [options, &context] {
      CheckOptions check_options;
      check_options.quiet = context.quiet;
      const CheckReport report = check_rig(read_rig(options->rig), options->shots, check_options);
      if (!context.quiet) context.out << check_table(report);
      return report.passed() ? 0 : 1;
    };
  });
}

}  // namespace scattermeter::apps
