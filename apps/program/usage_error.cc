#include "apps/program/usage_error.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <iomanip>
#include <regex>
#include <sstream>

#include "core/base/nearest_name.h"

namespace scattermeter::apps {
namespace {

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    if (!command->get_group().empty()) names.push_back(command->get_name());  // not hidden
  }
  return names;
}

std::string listed(const std::vector<std::string>& names) {
  std::string out;
  for (const std::string& name : names) out += (out.empty() ? "" : ", ") + name;
  return out;
}

const CLI::App* command_of(const CLI::App& app, const std::string& word) {
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    if (command->get_name() == word) return command;
  }
  return nullptr;
}

// "--out" and "-q", not "-0.5" or "-".
bool is_option_word(const std::string& word) {
  return word.size() > 1 && word[0] == '-' &&
         (word[1] == '-' || std::isalpha(static_cast<unsigned char>(word[1])) != 0);
}

// The option that the word names, in the command or in those it is a command of.
const CLI::Option* option_of(const std::vector<const CLI::App*>& commands,
                             const std::string& word) {
  for (const CLI::App* command : commands) {
    for (const CLI::Option* option : command->get_options()) {
      if (option->check_name(word)) return option;
    }
  }
  return nullptr;
}

std::vector<std::string> option_names(const std::vector<const CLI::App*>& commands) {
  std::vector<std::string> names;
  for (const CLI::App* command : commands) {
    for (const CLI::Option* option : command->get_options()) {
      for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    }
  }
  return names;
}

struct UsageReading {
  std::vector<const CLI::App*> commands;  // the program and the commands named, from first to last
  std::string fault;                      // a word that is no command or option
};

UsageReading read_usage(const CLI::App& app, const std::vector<std::string>& words) {
  UsageReading out{{&app}, ""};
  for (std::size_t i = 0; i < words.size() && words[i] != "--"; ++i) {
    const CLI::App& command = *out.commands.back();
    if (is_option_word(words[i])) {
      const std::string name = words[i].substr(0, words[i].find('='));
      const CLI::Option* option = option_of(out.commands, name);
      // Letters such as -qx may be several options; they are left to the library.
      if (option == nullptr && name.starts_with("--")) {
        out.fault = name + " is no option" +
                    (out.commands.size() > 1 ? " of " + command.get_name() : "") +
                    did_you_mean(name, option_names(out.commands));
        return out;
      }
      const bool has_value = option != nullptr && option->get_items_expected_min() > 0;
      if (has_value && name == words[i]) ++i;
      continue;
    }
    if (command.get_require_subcommand_min() == 0) continue;
    if (const CLI::App* named = command_of(command, words[i])) {
      out.commands.push_back(named);
      continue;
    }
    const std::vector<std::string> names = command_names(command);
    out.fault = words[i] + " is no command" + did_you_mean(words[i], names) +
                " (there are: " + listed(names) + ")";
    return out;
  }
  if (const CLI::App& last = *out.commands.back(); last.get_require_subcommand_min() > 0) {
    out.fault = "name what to " + (out.commands.size() > 1 ? last.get_name() : std::string("do")) +
                ": " + listed(command_names(last));
  }
  return out;
}

// "--threads: Value 0 not in range 0.000000 to 17976..." of CLI::Range; no limit where it is a
// number's largest.
std::string with_range(const std::string& message) {
  static const std::regex pattern(R"((.*): Value (.*) not in range (.*) to (.*))");
  std::smatch match;
  if (!std::regex_match(message, match, pattern)) return message;
  const double low = std::stod(match[3]), high = std::stod(match[4]);
  std::ostringstream out;
  out << std::setprecision(15) << match[1] << ": expected a ";
  // An integer such as 1e6 lies within the range, and is not read as one.
  char* end = nullptr;
  const std::string word = match[2];
  const double value = std::strtod(word.c_str(), &end);
  const bool is_number = !word.empty() && *end == '\0';
  const bool is_within = is_number && value >= low && value <= high;
  if (high < 1e300) {
    out << (is_within ? "whole number, written in digits, from " : "number from ") << low << " to "
        << high;
  } else {
    out << "positive number";
  }
  out << ", got " << match[2];
  return out.str();
}

// "--rig: 1 required TEXT missing", "--rig: At Most 1 required but received 2".
std::string with_count(const std::string& message) {
  static const std::regex missing(R"((.*): \d+ required .* missing)");
  static const std::regex count(R"((.*): At ([Ll]east|[Mm]ost) (\d+) required but received (\d+))");
  std::smatch match;
  if (std::regex_match(message, match, missing)) return match[1].str() + ": needs a value";
  if (!std::regex_match(message, match, count)) return message;
  const std::string most = match[3];
  const bool is_most = match[2].str().ends_with("ost");
  if (is_most && most == "1") return match[1].str() + ": is given more than once";
  return match[1].str() + ": needs at " + (is_most ? "most " : "least ") + most + " values, got " +
         match[4].str();
}

// "--model: dipol not in {auto,dipole}" of CLI::IsMember, with the value that was probably meant.
std::string with_suggestion(const std::string& message) {
  static const std::regex pattern(R"((.*): (.*) not in \{(.*)\})");
  std::smatch match;
  if (!std::regex_match(message, match, pattern)) return message;
  std::vector<std::string> values;
  std::istringstream list(match[3]);
  for (std::string value; std::getline(list, value, ',');) values.push_back(value);
  return match[1].str() + ": expected one of " + listed(values) + ", got " + match[2].str() +
         did_you_mean(match[2].str(), values);
}

}  // namespace

std::string usage_error(const CLI::App& app, const CLI::ParseError& error,
                        const std::vector<std::string>& words) {
  const UsageReading reading = read_usage(app, words);
  std::string command;
  for (const CLI::App* named : reading.commands) {
    command += (command.empty() ? "" : " ") + named->get_name();
  }
  std::string what =
      reading.fault.empty() ? with_count(with_range(with_suggestion(error.what()))) : reading.fault;
  return "scattermeter: " + what + "\nRun `" + command + " --help` for its options.\n";
}

}  // namespace scattermeter::apps
