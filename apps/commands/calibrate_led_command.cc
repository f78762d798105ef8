#include <filesystem>
#include <memory>
#include <ostream>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "apps/commands/commands.h"
#include "apps/instrument/calibration_inputs.h"
#include "apps/pages/calibration_page.h"
#include "apps/pages/led_plots.h"
#include "apps/report/calibration_tables.h"
#include "apps/results/result_json.h"
#include "apps/rig/led_calibration_file.h"
#include "calib/led/led_calibration.h"
#include "calib/lens/lens_of_points.h"
#include "capture/files/pending_file.h"

namespace scattermeter::apps {

void add_calibrate_led(CLI::App& calibrate, CommandContext& context) {
  struct Options {
    std::string shots, rig, light, out;
  };
  const auto options = std::make_shared<Options>();
  CLI::App* command = calibrate.add_subcommand(
      "led",
      "Position, axis, exponent and intensity of an LED from shots of mirror spheres and a white "
      "plane (the rig's calibration.led).\n"
      "In a room that is not dark, also take a shot of the plane with the LED off (kind: "
      "ambient).\n"
      "The search starts from the rig's values, which may be off by a fifth of the distance.\n"
      "Exit status: 0 calibrated, 1 refused (the shots do not determine it), 2 bad input.");
  command->add_option("SHOTS", options->shots, "folder of the raw files")->required();
  command->add_option("--rig", options->rig, "rig file (YAML) with calibration.led")->required();
  command->add_option("--light", options->light,
                      "name of the LED in the rig (default: all of calibration.led)");
  command
      ->add_option(
          "--out", options->out,
          "file to write (YAML, for the rig's lights.NAME.calibration), with a page (HTML) "
          "next to it; without --light, the folder for NAME.yaml")
      ->required();
  run_if_named(*command, context, [options, &context] {
    if (options->light.empty()) {
      capture::require_output_folder(options->out);
    } else {
      capture::require_output_file(options->out, {options->rig, options->shots});
    }
    Rig rig = read_rig(options->rig);
    const std::string lens =
        calib::take_points_and_lens(rig.scene, rig.decoding, options->shots, rig.pose);
    if (!lens.empty()) context.err << "note: " << lens << "\n";
    const calib::LedCalibrationInput input = led_calibration_input(rig);
    const bool all = options->light.empty();
    const std::vector<std::string> lights =
        all ? input.shots.lights() : std::vector<std::string>{options->light};
    const auto path_of = [&](const std::string& light) {
      return all ? (std::filesystem::path(options->out) / (light + ".yaml")).string()
                 : options->out;
    };
    if (all) {
      for (const std::string& light : lights) {
        capture::require_output_file(path_of(light), {options->rig});
      }
    }
    const calib::LedFrames frames = led_frames_in(rig, options->shots);
    bool refused = false;
    for (const std::string& light : lights) {
      const calib::LedCalibration calibration = calib::calibrate_led(input, light, frames);
      for (const std::string& note : calibration.shots.notes) {
        context.err << "note: " << note << "\n";
      }
      for (const std::string& warning : calibration.fit.warnings) {
        context.err << "warning: " << light << ": " << warning << "\n";
      }
      const bool ok = calibration.fit.status == calib::LedStatus::kOk;
      refused = refused || !ok;
      const std::string table = led_calibration_table(calibration);
      if (!context.quiet || !ok) context.out << table;
      if (!ok) continue;
      if (!rig.scene.camera.responsivity && !context.quiet) {
        context.out << "the rig has no responsivity: intensities count for 1e10 counts mm2 sr / "
                       "(W s) in each channel\n";
      }
      const std::string path = path_of(light);
      capture::write_text_file(path, led_calibration_yaml(calibration));
      const std::string page = write_page_beside(
          path, calibration_page(
                    {"Calibration of " + light, led_calibration_verdict(calibration),
                     fmt::format("In the rig: lights: {{{}: {{type: led, calibration: {}}}}}",
                                 light, path),
                     true, table, led_fit_plots(calibration)},
                    context.command_line));
      if (!context.quiet) context.out << "written: " << path << "\n" << page;
    }
    return refused ? 1 : 0;
  });
}

}  // namespace scattermeter::apps
