#include <memory>
#include <ostream>

#include "apps/commands.h"
#include "apps/simulate.h"

namespace scattermeter::apps {

void add_simulate_command(CLI::App& app, CommandContext& context) {
  struct Options {
    std::string rig, out, transport = "dipole", noise = "on";
    SimulateOptions simulate;
  };
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "simulate",
      "Make the raw shots that a rig would have taken of its truth materials (12-bit DNG).\n"
      "The rig needs truth.materials; the exposure time is chosen where the rig has none.");
  command->add_option("RIG", options->rig, "rig file (YAML)")->required();
  command->add_option("--out", options->out, "folder for the raws; made where missing")->required();
  command->add_option("--transport", options->transport, "how light moves in the material: dipole")
      ->check(CLI::IsMember({"dipole"}))
      ->capture_default_str();
  command->add_option("--seed", options->simulate.seed, "of the noise")->capture_default_str();
  command->add_option("--noise", options->noise, "on: photon and read noise; off: rounding only")
      ->check(CLI::IsMember({"on", "off"}))
      ->capture_default_str();
  command->callback([options, &context] {
    context.chosen = [options, &context] {
      options->simulate.noise = options->noise == "on";
      options->simulate.quiet = context.quiet;
      const std::vector<std::string> paths =
          simulate(read_rig(options->rig), options->out, options->simulate);
      if (!context.quiet) {
        context.out << paths.size() << " shots written to " << options->out << "\n";
      }
      return 0;
    };
  });
}

}  // namespace scattermeter::apps
