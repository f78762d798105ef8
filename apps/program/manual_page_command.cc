#include <ostream>
#include <vector>

#include <fmt/format.h>

#include "apps/commands/commands.h"
#include "core/base/version.h"

namespace scattermeter::apps {
namespace {

using ShownOptions = std::vector<const CLI::Option*>;

std::string replace_all(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size()) {
    text.replace(at, from.size(), to);
  }
  return text;
}

// Those in the group "" are not shown by --help either.
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

// The values of an option with a choice, whose type is written TEXT:{a,b,c}, as a|b|c.
std::string choices_of(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const std::size_t begin = type.find('{');
  const std::size_t end = type.find('}');
  if (begin == std::string::npos || end == std::string::npos) return "";
  return replace_all(type.substr(begin + 1, end - begin - 1), ",", "|");
}

// Text for roff: escapes are disabled, and no line can be taken for a request.
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
  page += fmt::format("{}", fmt::join(names, ", "));
  const std::string choices = choices_of(option);
  if (!choices.empty()) {
    page += " " + roff(choices);
  } else if (option.get_items_expected_max() > 0 && !option.get_positional()) {
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

// A section for each command below `app`, titled with the names that lead to it: "scattermeter
// calibrate led SHOTS".
void manual_commands(const CLI::App& app, const std::string& path, std::string& page) {
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    if (command->get_group().empty()) continue;
    const std::string name = path + " " + command->get_name();
    std::string usage = name;
    for (const CLI::Option* option : shown_options(*command, true)) {
      usage += " " + option->get_name();
    }
    page += ".SS \"" + roff(usage) + "\"\n" + roff(command->get_description()) + "\n";
    for (const bool positional : {true, false}) {
      for (const CLI::Option* option : shown_options(*command, positional)) {
        manual_option(*option, page);
      }
    }
    manual_commands(*command, name, page);
  }
}

// A page of section 1 for man(1) with every command and option that --help shows.
std::string manual_page(const CLI::App& app) {
  std::string page =
      ".TH SCATTERMETER 1 \"\" \"scattermeter " + roff(kVersion) +
      "\" \"User Commands\"\n.SH NAME\nscattermeter \\- scattering and absorption of "
      "translucent materials from raw camera shots\n.SH SYNOPSIS\n.B scattermeter\n"
      "[\\fIoptions\\fR] \\fIcommand\\fR ...\n.SH DESCRIPTION\n" +
      roff(app.get_description()) + "\n.SH OPTIONS\n";
  for (const CLI::Option* option : shown_options(app, false)) manual_option(*option, page);
  page += ".SH COMMANDS\n";
  manual_commands(app, app.get_name(), page);
  page +=
      ".SH EXIT STATUS\n.TP\n0\nSuccess: done, or all values measured.\n.TP\n1\nAt least one value "
      "was refused, or a check failed.\n.TP\n2\nBad input or usage; the message names file, field "
      "and value.\n";
  return page;
}

}  // namespace

void add_manual_page_command(CLI::App& app, CommandContext& context) {
  CLI::App* command = app.add_subcommand("manual-page", "Print the manual page.")->group("");
  run_if_named(*command, context, [&app, &context] {
    context.out << manual_page(app);
    return 0;
  });
}

}  // namespace scattermeter::apps
