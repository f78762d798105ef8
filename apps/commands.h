// One declaration per command: its options on a CLI11 app, its body when it is chosen.
#pragma once

#include <functional>
#include <iosfwd>
#include <string>

#include <CLI/CLI.hpp>

namespace scattermeter::apps {

// What every command gets.
struct CommandContext {
  std::ostream& out;
  std::ostream& err;
  bool quiet = false;
  int threads = 0;  // 0: all cores
  std::string command_line;
  std::function<int()> chosen;  // set by the command that was named; returns the exit status
};

void add_measure_command(CLI::App& app, CommandContext& context);
void add_check_command(CLI::App& app, CommandContext& context);
void add_calibrate_command(CLI::App& app, CommandContext& context);
void add_simulate_command(CLI::App& app, CommandContext& context);
void add_render_command(CLI::App& app, CommandContext& context);
void add_export_command(CLI::App& app, CommandContext& context);
void add_pages_command(CLI::App& app, CommandContext& context);
void add_plan_command(CLI::App& app, CommandContext& context);
void add_bench_command(CLI::App& app, CommandContext& context);

}  // namespace scattermeter::apps
