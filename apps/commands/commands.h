// The commands: each function adds one with its options and its body to a CLI11 app.
#pragma once

#include <functional>
#include <iosfwd>
#include <string>
#include <utility>

#include <CLI/CLI.hpp>

#include "capture/files/output_place.h"
#include "core/base/input_error.h"
#include "core/base/progress.h"
#include "core/transport/path_peers.h"

namespace scattermeter::apps {

// What every command receives.
struct CommandContext {
  std::ostream& out;
  std::ostream& err;
  bool quiet = false;
  Progress* progress = nullptr;  // null: not shown
  int threads = 0;               // 0: all cores
  std::string command_line;
  PathPeers* peers = nullptr;  // processes that run this command together
  // Set by the command that was named: whether it can use the peers, and its body, which returns
  // the exit status.
  bool shares_paths = false;
  std::function<int()> chosen;
};

// Makes `body` what runs if the command is named on the command line.
inline void run_if_named(CLI::App& command, CommandContext& context, std::function<int()> body,
                         bool shares_paths = false) {
  command.callback([&context, body = std::move(body), shares_paths] {
    context.chosen = body;
    context.shares_paths = shares_paths;
  });
}

// Throws InputError, before the work starts, unless results can be written to the folder, which is
// not that of the shots.
inline void require_results_folder(const std::string& out, const std::string& shots) {
  if (capture::is_same_folder(out, shots)) {
    throw InputError("--out",
                     "is the folder of the shots, results need a folder of their own, got " + out);
  }
  capture::require_output_folder(out);
}

void add_init_command(CLI::App& app, CommandContext& context);
void add_print_command(CLI::App& app, CommandContext& context);
void add_measure_command(CLI::App& app, CommandContext& context);
void add_check_command(CLI::App& app, CommandContext& context);
void add_watch_command(CLI::App& app, CommandContext& context);
void add_compare_command(CLI::App& app, CommandContext& context);
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
