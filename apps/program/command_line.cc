#include "apps/program/command_line.h"

#include <algorithm>
#include <ostream>
#include <thread>

#include <oneapi/tbb/global_control.h>
#include <unistd.h>

#include "apps/commands/commands.h"
#include "apps/program/library_versions.h"
#include "apps/program/progress_bar.h"
#include "apps/program/usage_error.h"
#include "core/base/input_error.h"
#include "core/base/version.h"

namespace scattermeter::apps {
namespace {

// The word, quoted for a shell if necessary.
std::string quoted(const std::string& word) {
  if (!word.empty() && word.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                              "0123456789-_./=:,+@%") == std::string::npos) {
    return word;
  }
  std::string out = "'";
  for (char c : word) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

#ifndef SCATTERMETER_BENCH
// Takes the place of `bench` in builds without it.
void add_missing_bench_command(CLI::App& app, CommandContext& context) {
  CLI::App* command =
      app.add_subcommand("bench", "not in this build: configure it with -DSCATTERMETER_BENCH=ON");
  command->allow_extras();
  run_if_named(*command, context, []() -> int {
    throw InputError("bench", "is not in this build; configure it with -DSCATTERMETER_BENCH=ON");
  });
}
#endif

}  // namespace

int run_command_line(const std::vector<std::string>& arguments, std::ostream& out,
                     std::ostream& err, PathPeers* peers) {
  CommandContext context{out, err, false, nullptr, 0, "scattermeter", peers, false, {}};
  for (const std::string& argument : arguments) context.command_line += " " + quoted(argument);
  CLI::App app(
      "scattermeter measures how light scatters and is absorbed below a surface, from raw camera "
      "shots of an object of known shape under an LED of known position and power.",
      "scattermeter");
  app.require_subcommand(1);
  app.fallthrough();
  app.set_version_flag(
      "--version", std::string("scattermeter ") + kVersion + "\nbuilt with " + kLibraryVersions);
  app.add_flag("--quiet,-q", context.quiet, "print nothing but errors");
  app.add_option("--threads", context.threads,
                 "number of threads (default: all cores); the result does not depend on it")
      ->check(CLI::PositiveNumber);
  add_init_command(app, context);
  add_print_command(app, context);
  add_measure_command(app, context);
  add_check_command(app, context);
  add_watch_command(app, context);
  CLI::App* calibrate = app.add_subcommand(
      "calibrate", "Make the calibrations that a rig refers to from their shots (raws).");
  calibrate->require_subcommand(1);
  add_calibrate_camera(*calibrate, context);
  add_calibrate_led(*calibrate, context);
  add_calibrate_radiance(*calibrate, context);
  add_simulate_command(app, context);
  add_render_command(app, context);
  add_compare_command(app, context);
  add_export_command(app, context);
  add_plan_command(app, context);
#ifdef SCATTERMETER_BENCH
  add_bench_command(app, context);
#else
  add_missing_bench_command(app, context);
#endif
  add_manual_page_command(app, context);
  // CLI11 takes the words from last to first.
  std::vector<std::string> words(arguments.rbegin(), arguments.rend());
  try {
    app.parse(words);
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return app.exit(e, out, err);  // --help, --version
    err << usage_error(app, e, arguments);
    return 2;
  }
  const int threads = context.threads > 0
                          ? context.threads
                          : static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(threads));
  try {
    if (peers != nullptr && peers->count() > 1) {
      if (!context.shares_paths) {
        throw InputError("mpirun", "this command runs in one process, not in " +
                                       std::to_string(peers->count()) +
                                       "; only simulate and render share paths");
      }
      context.quiet = context.quiet || peers->rank() > 0;
    }
    ProgressBar bar;
    if (!context.quiet && isatty(STDERR_FILENO) != 0) context.progress = &bar;
    return context.chosen();
  } catch (const InputError& e) {
    err << "scattermeter: " << e.what() << "\n";
    return 2;
  }
}

}  // namespace scattermeter::apps
