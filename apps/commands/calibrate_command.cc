#include "apps/commands/commands.h"

namespace scattermeter::apps {

void add_calibrate_command(CLI::App& app, CommandContext& context) {
  CLI::App* calibrate = app.add_subcommand(
      "calibrate", "Make the calibrations that a rig refers to from their shots (raws).");
  calibrate->require_subcommand(1);
  add_calibrate_camera(*calibrate, context);
  add_calibrate_led(*calibrate, context);
  add_calibrate_radiance(*calibrate, context);
}

}  // namespace scattermeter::apps
