#include <memory>
#include <ostream>

#include "apps/checking/check.h"
#include "apps/commands/commands.h"
#include "apps/pages/check_page.h"
#include "apps/report/check_json.h"
#include "apps/report/check_table.h"
#include "apps/report/shot_picture.h"
#include "capture/files/pending_file.h"

namespace scattermeter::apps {

void add_check_command(CLI::App& app, CommandContext& context) {
  struct Options {
    std::string shots, rig, out;
  };
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "check",
      "Check whether the setup is consistent with its shots: camera settings, pose, exposure, "
      "noise, black level, exchanged lights and materials, the light of each shot relative to the "
      "joint model, other light, LED positions.\n"
      "Prints one line for each: residual (rms and worst, with its location), limit, verdict, and "
      "advice if it fails. With --out: check.json with all values, and check.html.\n"
      "Exit status: 0 all passed, 1 at least one failed, 2 bad input.");
  command->add_option("SHOTS", options->shots, "folder of the raw files")->required();
  command->add_option("--rig", options->rig, "rig file (YAML)")->required();
  command->add_option("--out", options->out, "folder for check.json and check.html");
  run_if_named(*command, context, [options, &context] {
    if (!options->out.empty()) require_results_folder(options->out, options->shots);
    CheckOptions check_options;
    check_options.progress = context.progress;
    if (!options->out.empty()) {
      check_options.draw_shot = shot_thumbnail;
    }
    const CheckedRig checked =
        open_checked_rig(read_rig(options->rig), options->shots, check_options);
    const CheckReport report = check_report(checked);
    if (!context.quiet) context.out << check_table(report);
    if (!options->out.empty()) {
      const std::string json = options->out + "/check.json";
      const std::string page = options->out + "/check.html";
      capture::write_text_file(json, check_json(report, context.command_line));
      capture::write_text_file(page, check_page(checked, report, context.command_line));
      if (!context.quiet) context.out << "written: " << json << ", " << page << "\n";
    }
    return report.passed() ? 0 : 1;
  });
}

}  // namespace scattermeter::apps
