// One declaration per command: its options on a CLI11 app, its body when it is chosen.
#pragma once

#include <functional>
#include <iosfwd>
#include <string>

#include <CLI/CLI.hpp>

#include "core/base/progress.h"
#include "core/transport/path_peers.h"

namespace scattermeter::apps {

// What every command gets.
struct CommandContext {
  std::ostream& out;
  std::ostream& err;
  bool quiet = false;
  Progress* progress = nullptr;  // null: none is shown
  int threads = 0;               // 0: all cores
  std::string command_line;
  PathPeers* peers = nullptr;   // processes that run this command together
  bool shares_paths = false;    // set by the command that was named where it can make use of them
  std::function<int()> chosen;  // set by the command that was named; returns the exit status
};

void add_measure_command(CLI::App& app, CommandContext& context);
void add_check_command(CLI::App& app, CommandContext& context);
void add_calibrate_command(CLI::App& app, CommandContext& context);
void add_calibrate_camera(CLI::App& calibrate, CommandContext& context);
void add_calibrate_led(CLI::App& calibrate, CommandContext& context);
void add_calibrate_radiance(CLI::App& calibrate, CommandContext& context);
void add_simulate_command(CLI::App& app, CommandContext& context);
void add_render_command(CLI::App& app, CommandContext& context);
void add_export_command(CLI::App& app, CommandContext& context);
void add_manual_page_command(CLI::App& app, CommandContext& context);
void add_plan_command(CLI::App& app, CommandContext& context);
void add_bench_command(CLI::App& app, CommandContext& context);

}  // namespace scattermeter::apps
