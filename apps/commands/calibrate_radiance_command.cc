#include <algorithm>
#include <filesystem>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include <fmt/core.h>

#include "apps/commands/commands.h"
#include "apps/instrument/calibration_inputs.h"
#include "apps/pages/calibration_page.h"
#include "apps/report/calibration_tables.h"
#include "apps/report/plot.h"
#include "apps/report/radiance_plots.h"
#include "apps/results/result_json.h"
#include "apps/rig/radiance_file.h"
#include "calib/pose/shot_pose.h"
#include "calib/radiance/calibrate_radiance.h"
#include "capture/files/pending_file.h"

namespace scattermeter::apps {
namespace {

// Writes plots of linearity and noise next to the file; returns notes of those that it cannot.
std::string draw_radiance(const capture::RadianceCalibration& calibration,
                          const std::string& stem) {
  std::string notes;
  for (std::size_t c = 0; c < kRgb; ++c) {
    notes += note_unless_drawn(photon_transfer_plot(calibration, c),
                               fmt::format("{}_noise_{}.png", stem, kRgbName[c]));
  }
  return notes + note_unless_drawn(linearity_plot(calibration), stem + "_linearity.png");
}

std::vector<PagePlot> plots_of(const capture::RadianceCalibration& calibration) {
  std::vector<PagePlot> out = {
      {linearity_plot(calibration),
       "Recorded signal relative to that of a camera with the sensitivity at zero signal."}};
  for (std::size_t c = 0; c < kRgb; ++c) {
    out.push_back({photon_transfer_plot(calibration, c),
                   fmt::format("Variance over signal in {} of the pairs of flats, with the noise "
                               "model.",
                               kRgbName[c])});
  }
  return out;
}

}  // namespace

void add_calibrate_radiance(CLI::App& calibrate, CommandContext& context) {
  struct Options {
    std::string shots, rig, out = "radiance.yaml";
  };
  const auto options = std::make_shared<Options>();
  CLI::App* command = calibrate.add_subcommand(
      "radiance",
      "Black, dark current, hot pixels, read noise, gain, linearity, exposure times, vignetting, "
      "glare and responsivity from the shots that the rig's calibration.radiance lists.\n"
      "Writes the file for camera.radiance, and plots of noise and linearity and a page (HTML) "
      "next to it.\n"
      "Exit status: 0 done, 1 a residual exceeds its limit, 2 bad input.");
  command->add_option("SHOTS", options->shots, "folder of the raw files")->required();
  command->add_option("--rig", options->rig, "rig file (YAML)")->required();
  command->add_option("--out", options->out, "file to write")->capture_default_str();
  run_if_named(*command, context, [options, &context] {
    capture::require_output_file(options->out, {options->rig, options->shots});
    Rig rig = read_rig(options->rig, false);
    // Only the white reference depends on the pose of the camera.
    if (rig.calibration.radiance && rig.calibration.radiance->white) {
      calib::take_points_from_board_shot(rig.scene, rig.decoding, options->shots, rig.pose);
    }
    const capture::RadianceCalibration calibration = calib::calibrate_radiance(
        radiance_calibration_input(rig), radiance_frames_in(rig, options->shots));
    capture::write_text_file(options->out, radiance_file_text(calibration));
    std::filesystem::path stem(options->out);
    const std::string notes = draw_radiance(calibration, stem.replace_extension().string());
    std::string text = notes + radiance_calibration_table(calibration);
    const auto exceeds = std::find_if(calibration.residuals.begin(), calibration.residuals.end(),
                                      [](const auto& r) { return r.rms > r.limit; });
    const bool ok = exceeds == calibration.residuals.end();
    text += write_page_beside(
        options->out,
        calibration_page({"Radiance calibration",
                          ok ? "All residuals are within their limits."
                             : fmt::format("The residual of {} exceeds its limit.", exceeds->what),
                          ok ? fmt::format("In the rig: camera: {{radiance: {}}}", options->out)
                             : "See below what it is made of; take those shots again.",
                          ok, text, plots_of(calibration)},
                         context.command_line));
    if (!context.quiet) context.out << text;
    return ok ? 0 : 1;
  });
}

}  // namespace scattermeter::apps
