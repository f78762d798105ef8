// Messages for command lines that cannot be understood.
#pragma once

#include <string>
#include <vector>

#include "apps/commands/commands.h"

namespace scattermeter::apps {

// What is wrong with the words of a command line that `app` has refused with `error`, in one line
// that begins with the program's name and suggests the command, option or value that was probably
// meant, and a line on --help. A wrong command or option is named first, whatever else is missing.
std::string usage_error(const CLI::App& app, const CLI::ParseError& error,
                        const std::vector<std::string>& words);

}  // namespace scattermeter::apps
