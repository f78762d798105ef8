#include <memory>
#include <ostream>
#include <regex>
#include <string>
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

// The values of an option with a choice, whose type is written TEXT:{a,b,c} or {a->0,b->1}, as
// a|b|c or a|b.
std::string choices_of(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const std::size_t begin = type.find('{');
  const std::size_t end = type.find('}');
  if (begin == std::string::npos || end == std::string::npos) return "";
  const std::string listed = replace_all(type.substr(begin + 1, end - begin - 1), ",", "|");
  return std::regex_replace(listed, std::regex("->[^|]*"), "");
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

// The section of one command, titled with the names that lead to it, and of those below it:
// "scattermeter calibrate led SHOTS".
void manual_command(const CLI::App& command, const std::string& path, std::string& page) {
  if (command.get_group().empty()) return;
  const std::string name = path + " " + command.get_name();
  std::string usage = name;
  for (const CLI::Option* option : shown_options(command, true)) usage += " " + option->get_name();
  page += ".SS \"" + roff(usage) + "\"\n" + roff(command.get_description()) + "\n";
  for (const bool positional : {true, false}) {
    for (const CLI::Option* option : shown_options(command, positional)) {
      manual_option(*option, page);
    }
  }
  for (const CLI::App* below : command.get_subcommands([](const CLI::App*) { return true; })) {
    manual_command(*below, name, page);
  }
}

std::string manual_head(const std::string& title, const std::string& name,
                        const std::string& synopsis) {
  return ".TH " + title + " 1 \"\" \"scattermeter " + roff(kVersion) +
         "\" \"User Commands\"\n.SH NAME\n" + roff(name) + "\n.SH SYNOPSIS\n.B scattermeter\n" +
         synopsis + "\n.SH DESCRIPTION\n";
}

// What a line of a page is about, and what it says of it.
struct ManualEntry {
  std::string subject;
  std::string words;
};

void manual_section(const std::string& title, const std::vector<ManualEntry>& entries,
                    std::string& page) {
  page += ".SH " + title + "\n";
  for (const ManualEntry& entry : entries) {
    page += ".TP\n\\fB" + roff(entry.subject) + "\\fR\n" + roff(entry.words) + "\n";
  }
}

const std::vector<ManualEntry> kExitStatus = {
    {"0", "Success: done, or all values measured."},
    {"1", "At least one value was refused, or a check failed."},
    {"2", "Bad input or usage; the message names file, field and value."}};

const std::vector<ManualEntry> kExamples = {
    {"scattermeter init --example --out rig.yaml",
     "Write a complete rig that can be simulated, measured and changed at once."},
    {"scattermeter simulate rig.yaml --out shots",
     "Make the raw shots that a camera would take of it."},
    {"scattermeter init shots --out rig.yaml --body cube:20 --led left:-60,-80,120",
     "Begin the rig file of one's own shots of a cube of 20 mm under one LED."},
    {"scattermeter check shots --rig rig.yaml --out check",
     "See whether the setup is what the rig says; the page is check/check.html."},
    {"scattermeter measure shots --rig rig.yaml --out result",
     "Measure every material and channel; the values are in result/result.json."},
    {"scattermeter measure shots --rig rig.yaml --out pom --material POM --channels G",
     "Measure the green channel of one material."},
    {"scattermeter compare a/result.json b/result.json",
     "Judge whether two results are of the same material."},
    {"scattermeter export result/result.json --format mitsuba --out plastic.xml",
     "Take a measured material to a renderer."}};

const std::vector<ManualEntry> kFiles = {
    {"rig.yaml",
     "The rig: camera, pose, objects, lights and shots. Meshes and calibrations that it names are "
     "found relative to it. Its keys are described by share/scattermeter/rig.schema.json."},
    {"OUT/result.json, OUT/result.html",
     "The answers with uncertainties, budgets, and reasons for what is refused; described by "
     "share/scattermeter/result.schema.json, whose $id it names as its $schema."},
    {"OUT/cache",
     "What the raw files decode to. It may be deleted at any time (measure --no-cache keeps "
     "none)."},
    {"OUT/atlas",
     "Views, the dipole's weights of light and light paths of transport, which later measurements "
     "with the same jig use again (measure --atlas FOLDER). It may be deleted at any time."}};

// A page of section 1 for man(1) with every command and option that --help shows, but for those of
// `bench`, which has its own page.
std::string manual_page(const CLI::App& app) {
  std::string page = manual_head("SCATTERMETER",
                                 "scattermeter - scattering and absorption of translucent "
                                 "materials from raw camera shots",
                                 "[\\fIoptions\\fR] \\fIcommand\\fR ...") +
                     roff(app.get_description()) + "\n.SH OPTIONS\n";
  for (const CLI::Option* option : shown_options(app, false)) manual_option(*option, page);
  page += ".SH COMMANDS\n";
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    if (command->get_name() != "bench") manual_command(*command, app.get_name(), page);
  }
  manual_section("EXIT STATUS", kExitStatus, page);
  manual_section("EXAMPLES", kExamples, page);
  manual_section("FILES", kFiles, page);
  return page + ".SH SEE ALSO\n\\fBscattermeter\\-bench\\fR(1), \\fBdcraw\\fR(1)\n";
}

// The page of `bench`. InputError where the program was built without it.
std::string bench_manual_page(const CLI::App& app) {
  const auto found =
      app.get_subcommands([](const CLI::App* c) { return c->get_name() == "bench"; });
  if (found.empty())
    throw InputError("--bench", "this program was built without the command bench");
  std::string page = manual_head("SCATTERMETER-BENCH",
                                 "scattermeter-bench - how accurate, how fast and how honest "
                                 "scattermeter is on this machine",
                                 "\\fBbench\\fR [\\fIoptions\\fR] \\fIbenchmark\\fR ...");
  page += roff(found.front()->get_description()) + "\n.SH OPTIONS\n";
  for (const CLI::Option* option : shown_options(*found.front(), false)) {
    manual_option(*option, page);
  }
  page += ".SH BENCHMARKS\n";
  for (const CLI::App* command :
       found.front()->get_subcommands([](const CLI::App*) { return true; })) {
    manual_command(*command, "scattermeter bench", page);
  }
  manual_section("EXIT STATUS", kExitStatus, page);
  manual_section("FILES",
                 {{"bench",
                   "Folder below the current one for tables (CSV) and plots (PNG, SVG); --out "
                   "names another."}},
                 page);
  return page + ".SH SEE ALSO\n\\fBscattermeter\\fR(1)\n";
}

}  // namespace

void add_manual_page_command(CLI::App& app, CommandContext& context) {
  CLI::App* command = app.add_subcommand("manual-page", "Print the manual page.")->group("");
  const auto of_bench = std::make_shared<bool>(false);
  command->add_flag("--bench", *of_bench, "the page of bench");
  run_if_named(*command, context, [&app, &context, of_bench] {
    context.out << (*of_bench ? bench_manual_page(app) : manual_page(app));
    return 0;
  });
}

}  // namespace scattermeter::apps
