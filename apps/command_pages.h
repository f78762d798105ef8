// The commands as a manual page and as completions of shells: what --help says, for other readers.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace scattermeter::apps {

// A page of section 1 for man(1), with every command and option.
std::string manual_page(const CLI::App& app, const std::string& version);

// A script for bash: commands, options, the values of those that have a choice, else files.
std::string bash_completion(const CLI::App& app);

// The same for zsh, with what each option is for (a file _scattermeter on its fpath).
std::string zsh_completion(const CLI::App& app);

}  // namespace scattermeter::apps
