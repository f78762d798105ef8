#include <filesystem>
#include <memory>
#include <ostream>

#include <fmt/core.h>

#include "apps/calibrate_commands.h"
#include "apps/calibrate_radiance.h"
#include "apps/plot.h"
#include "apps/radiance_plots.h"
#include "apps/raw_shot.h"
#include "apps/result_json.h"
#include "apps/shot_pose.h"

namespace scattermeter::apps {
namespace {

// Linearity and noise, beside the file.
void draw_radiance(const RadianceCalibration& calibration, const std::string& stem) {
  for (std::size_t c = 0; c < kRgb; ++c) {
    write_plot(photon_transfer_plot(calibration, c),
               fmt::format("{}_noise_{}.png", stem, kRgbName[c]));
  }
  write_plot(linearity_plot(calibration), stem + "_linearity.png");
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
      "Writes the file that camera.radiance names, and pictures of noise and linearity beside it.\n"
      "Exit status: 0 done, 1 a residual exceeds its limit, 2 bad input.");
  command->add_option("SHOTS", options->shots, "folder of the raw files")->required();
  command->add_option("--rig", options->rig, "rig file (YAML)")->required();
  command->add_option("--out", options->out, "file to write")->capture_default_str();
  command->callback([options, &context] {
    context.chosen = [options, &context] {
      Rig rig = read_rig(options->rig, false);
      // Where the camera stands matters to the white reference alone.
      if (rig.calibration.radiance && rig.calibration.radiance->white) {
        take_points_from_board_shot(options->shots, rig);
      }
      const RadianceFrameSource open = [&](const RadianceShot& shot) {
        return open_shot(rig, (std::filesystem::path(options->shots) / shot.file).string());
      };
      const RadianceResult result = calibrate_radiance(rig, open);
      write_text_file(options->out, radiance_file_text(result.calibration));
      std::filesystem::path stem(options->out);
      draw_radiance(result.calibration, stem.replace_extension().string());
      if (!context.quiet) context.out << radiance_table(result.calibration);
      for (const RadianceResidual& r : result.calibration.residuals) {
        if (r.rms > r.limit) return 1;
      }
      return 0;
    };
  });
}

}  // namespace scattermeter::apps
