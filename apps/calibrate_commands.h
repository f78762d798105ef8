// The commands below `calibrate`, one file each.
#pragma once

#include "apps/commands.h"

namespace scattermeter::apps {

void add_calibrate_camera(CLI::App& calibrate, CommandContext& context);
void add_calibrate_led(CLI::App& calibrate, CommandContext& context);
void add_calibrate_radiance(CLI::App& calibrate, CommandContext& context);

}  // namespace scattermeter::apps
