#include "apps/calibrate_commands.h"

namespace scattermeter::apps {

void add_calibrate_led(CLI::App& calibrate, CommandContext& context) {
  static_cast<void>(calibrate);
  static_cast<void>(context);
}

}  // namespace scattermeter::apps
