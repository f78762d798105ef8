#include <memory>
#include <ostream>

#include "apps/command_pages.h"
#include "apps/commands.h"
#include "apps/version.h"

namespace scattermeter::apps {

// Not in --help: what packages are made with.
void add_pages_command(CLI::App& app, CommandContext& context) {
  const auto what = std::make_shared<std::string>();
  CLI::App* command =
      app.add_subcommand("pages", "Print the manual page, or the completion of a shell.")
          ->group("");
  command->add_option("WHAT", *what, "man, bash or zsh")
      ->required()
      ->check(CLI::IsMember({"man", "bash", "zsh"}));
  command->callback([what, &app, &context] {
    context.chosen = [what, &app, &context] {
      context.out << (*what == "man"    ? manual_page(app, kVersion)
                      : *what == "bash" ? bash_completion(app)
                                        : zsh_completion(app));
      return 0;
    };
  });
}

}  // namespace scattermeter::apps
