#include "apps/command_pages.h"

#include <functional>
#include <sstream>
#include <vector>

#include "apps/commands.h"
#include "apps/joined_words.h"

namespace scattermeter::apps {
namespace {

using ShownOptions = std::vector<const CLI::Option*>;
using ShownCommands = std::vector<const CLI::App*>;

std::string replace_all(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size()) {
    text.replace(at, from.size(), to);
  }
  return text;
}

// Those with a group; "" is the group of what --help does not show.
ShownCommands shown_commands(const CLI::App& app) {
  ShownCommands out;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    if (!command->get_group().empty()) out.push_back(command);
  }
  return out;
}

ShownOptions shown_options(const CLI::App& app, bool positional) {
  ShownOptions out;
  for (const CLI::Option* option : app.get_options([](const CLI::Option*) { return true; })) {
    if (!option->get_group().empty() && option->get_positional() == positional) {
      out.push_back(option);
    }
  }
  return out;
}

// "-q" and "--quiet".
std::vector<std::string> flags_of(const CLI::Option& option) {
  std::vector<std::string> out;
  for (const std::string& name : option.get_snames()) out.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) out.push_back("--" + name);
  return out;
}

bool takes_value(const CLI::Option& option) { return option.get_items_expected_max() > 0; }

// Of a choice, whose type reads TEXT:{a,b,c}.
std::vector<std::string> choices_of(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const std::size_t begin = type.find('{');
  const std::size_t end = type.find('}');
  std::vector<std::string> out;
  if (begin == std::string::npos || end == std::string::npos) return out;
  std::istringstream words(type.substr(begin + 1, end - begin - 1));
  for (std::string word; std::getline(words, word, ',');) out.push_back(word);
  return out;
}

// Every command with the names that lead to it: "scattermeter calibrate led".
using Visit = std::function<void(const CLI::App&, const std::string&)>;
void visit_commands(const CLI::App& app, const std::string& path, const Visit& visit) {
  visit(app, path);
  for (const CLI::App* command : shown_commands(app)) {
    visit_commands(*command, path + " " + command->get_name(), visit);
  }
}

// roff: no escapes of its own, no line that starts as a request.
std::string roff(const std::string& text) {
  std::string out = replace_all(replace_all(text, "\\", "\\e"), "-", "\\-");
  out = replace_all(out, "\n.", "\n\\&.");
  out = replace_all(out, "\n'", "\n\\&'");
  if (!out.empty() && (out[0] == '.' || out[0] == '\'')) out.insert(0, "\\&");
  return replace_all(out, "\n", "\n.br\n");
}

void manual_option(const CLI::Option& option, std::string& page) {
  page += ".TP\n";
  std::vector<std::string> names;
  for (const std::string& flag : flags_of(option)) names.push_back("\\fB" + roff(flag) + "\\fR");
  if (names.empty()) names.push_back("\\fI" + roff(option.get_name()) + "\\fR");
  page += joined_words(names, ", ");
  const std::vector<std::string> choices = choices_of(option);
  if (!choices.empty()) {
    page += " " + roff(joined_words(choices, "|"));
  } else if (takes_value(option) && !option.get_positional()) {
    page += " \\fI" + roff(option.get_type_name()) + "\\fR";
  }
  page += "\n" + roff(option.get_description());
  if (!option.get_default_str().empty()) {
    page += roff(" (default: " + option.get_default_str() + ")");
  } else if (option.get_required()) {
    page += " (needed)";
  }
  page += "\n";
}

// In single quotes for a shell.
std::string shell_quoted(const std::string& text) {
  return "'" + replace_all(text, "'", "'\\''") + "'";
}

std::vector<std::string> all_flags(const CLI::App& app) {
  std::vector<std::string> out;
  for (const CLI::Option* option : shown_options(app, false)) {
    for (const std::string& flag : flags_of(*option)) out.push_back(flag);
  }
  return out;
}

// Those of the program that stand behind any command, which has its own --help.
ShownOptions common_options(const CLI::App& app) {
  ShownOptions out = shown_options(app, false);
  std::erase_if(out, [&](const CLI::Option* option) {
    return option == app.get_help_ptr() || option == app.get_version_ptr();
  });
  return out;
}

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

std::string zsh_function(const std::string& path) { return "_" + replace_all(path, " ", "_"); }

// One option as _arguments takes it; colons and brackets are its own signs.
std::string zsh_option(const CLI::Option& option) {
  std::string help = replace_all(option.get_description(), "\n", " ");
  for (const char* sign : {"\\", "[", "]", ":"}) {
    help = replace_all(help, sign, std::string("\\") + sign);
  }
  std::string value;
  if (takes_value(option)) {
    const std::vector<std::string> choices = choices_of(option);
    value = choices.empty() ? ":value:_files" : ":value:(" + joined_words(choices, " ") + ")";
  }
  std::string out;
  for (const std::string& flag : flags_of(option)) {
    out += "    " + shell_quoted("*" + flag + "[" + help + "]" + value) + " \\\n";
  }
  return out;
}

}  // namespace

std::string manual_page(const CLI::App& app, const std::string& version) {
  std::string page =
      ".TH SCATTERMETER 1 \"\" \"scattermeter " + roff(version) +
      "\" \"User Commands\"\n.SH NAME\nscattermeter \\- scattering and absorption of "
      "translucent materials from raw camera shots\n.SH SYNOPSIS\n.B scattermeter\n"
      "[\\fIoptions\\fR] \\fIcommand\\fR ...\n.SH DESCRIPTION\n" +
      roff(app.get_description()) + "\n.SH OPTIONS\n";
  for (const CLI::Option* option : shown_options(app, false)) manual_option(*option, page);
  page += ".SH COMMANDS\n";
  visit_commands(app, app.get_name(), [&](const CLI::App& command, const std::string& path) {
    if (&command == &app) return;
    std::string usage = path;
    for (const CLI::Option* option : shown_options(command, true)) {
      usage += " " + option->get_name();
    }
    page += ".SS \"" + roff(usage) + "\"\n" + roff(command.get_description()) + "\n";
    for (const bool positional : {true, false}) {
      for (const CLI::Option* option : shown_options(command, positional)) {
        manual_option(*option, page);
      }
    }
  });
  page +=
      ".SH EXIT STATUS\n.TP\n0\nDone, or measured.\n.TP\n1\nAt least one value was refused, or a "
      "check failed.\n.TP\n2\nBad input or usage; the message names file, field and value.\n";
  return page;
}

std::string bash_completion(const CLI::App& app) {
  std::vector<std::string> common;  // taken by every command
  for (const CLI::Option* option : common_options(app)) {
    for (const std::string& flag : flags_of(*option)) common.push_back(flag);
  }
  std::string commands, values, flags, words;
  visit_commands(app, app.get_name(), [&](const CLI::App& command, const std::string& path) {
    if (&command != &app) commands += (commands.empty() ? "" : "|") + shell_quoted(path);
    std::vector<std::string> own = all_flags(command);
    if (&command != &app) own.insert(own.end(), common.begin(), common.end());
    flags +=
        "      " + shell_quoted(path) + ") words=" + shell_quoted(joined_words(own, " ")) + " ;;\n";
    std::vector<std::string> names;
    for (const CLI::App* next : shown_commands(command)) names.push_back(next->get_name());
    if (!names.empty()) {
      words += "      " + shell_quoted(path) + ") words=" + shell_quoted(joined_words(names, " ")) +
               " ;;\n";
    }
    for (const CLI::Option* option : shown_options(command, false)) {
      if (!takes_value(*option)) continue;
      const std::vector<std::string> choices = choices_of(*option);
      for (const std::string& flag : flags_of(*option)) {
        // Without a choice: files, by `complete -o default`.
        const std::string set = choices.empty() ? "return"
                                                : "COMPREPLY=($(compgen -W " +
                                                      shell_quoted(joined_words(choices, " ")) +
                                                      " -- \"$cur\")); return";
        values += "    " + shell_quoted(path + " " + flag) + ") " + set + " ;;\n";
      }
    }
  });
  return "# bash completion of scattermeter, made by the program from its own options\n"
         "_scattermeter() {\n"
         "  local cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD-1]}\n"
         "  local path=scattermeter words= i\n"
         "  COMPREPLY=()\n"
         "  for ((i = 1; i < COMP_CWORD; ++i)); do\n"
         "    case \"$path ${COMP_WORDS[i]}\" in\n"
         "    " +
         commands +
         ") path=\"$path ${COMP_WORDS[i]}\" ;;\n"
         "    esac\n"
         "  done\n"
         "  case \"$path $prev\" in\n" +
         values +
         "  esac\n"
         "  if [[ $cur == -* ]]; then\n"
         "    case \"$path\" in\n" +
         flags +
         "    esac\n"
         "  else\n"
         "    case \"$path\" in\n" +
         words +
         "    esac\n"
         "  fi\n"
         "  COMPREPLY=($(compgen -W \"$words\" -- \"$cur\"))\n"
         "}\n"
         "complete -o default -F _scattermeter scattermeter\n";
}

std::string zsh_completion(const CLI::App& app) {
  std::string common;
  for (const CLI::Option* option : common_options(app)) common += zsh_option(*option);
  std::string out = "#compdef scattermeter\n# made by the program from its own options\n\n";
  visit_commands(app, app.get_name(), [&](const CLI::App& command, const std::string& path) {
    const std::string name = zsh_function(path);
    std::string options;
    for (const CLI::Option* option : shown_options(command, false)) {
      options += zsh_option(*option);
    }
    if (&command != &app) options += common;
    const ShownCommands next = shown_commands(command);
    out += name + "() {\n";
    if (next.empty()) {
      out += "  _arguments \\\n" + options + "    '*:file:_files'\n}\n\n";
      return;
    }
    out +=
        "  local curcontext=\"$curcontext\" state line\n  typeset -A opt_args\n  local -a "
        "commands\n"
        "  commands=(\n";
    for (const CLI::App* c : next) {
      out += "    " +
             shell_quoted(c->get_name() + ":" +
                          replace_all(first_line(c->get_description()), ":", "\\:")) +
             "\n";
    }
    out += "  )\n  _arguments -C \\\n" + options +
           "    '1: :->command' \\\n    '*:: :->rest'\n"
           "  case $state in\n  command) _describe command commands ;;\n"
           "  rest)\n    case $line[1] in\n";
    for (const CLI::App* c : next) {
      out += "    " + c->get_name() + ") " + name + "_" + c->get_name() + " ;;\n";
    }
    out += "    esac ;;\n  esac\n}\n\n";
  });
  return out + zsh_function(app.get_name()) + " \"$@\"\n";
}

}  // namespace scattermeter::apps
