#include <filesystem>
#include <memory>
#include <ostream>

#include "apps/calibrate_commands.h"
#include "apps/calibrate_radiance.h"
#include "apps/plot.h"
#include "apps/raw_shot.h"
#include "apps/result_json.h"
#include "apps/shot_pose.h"

namespace scattermeter::apps {
namespace {

// Linearity and noise, beside the file.
void draw_radiance(const RadianceResult& result, const std::string& stem) {
  const capture::RadianceCorrection& c = result.calibration.correction;
  Plot noise{"Photon transfer", {"signal [counts]"}, {"variance [counts^2]"}, {}};
  for (std::size_t k = 0; k < kRgb; ++k) {
    PlotSeries points{
        std::string("pairs of flats ") + kRgbName[k], PlotSeries::Style::kPoints, {}, {}};
    for (const RadianceCurves::Noise& n : result.curves.noise) {
      if (n.colour != k) continue;
      points.x.push_back(n.counts);
      points.y.push_back(n.variance_counts2);
    }
    noise.series.push_back(points);
  }
  const double top = c.response[0].knot_counts().back();
  PlotSeries model{"model G", PlotSeries::Style::kLine, {}, {}};
  PlotSeries departure{"departure", PlotSeries::Style::kLine, {}, {}};
  for (int i = 0; i <= 100; ++i) {
    const double y = top * i / 100.0;
    const double g = c.response[1].gain_at(y);
    model.x.push_back(y);
    model.y.push_back((c.response[1].light_counts(y) / c.noise[1].gain_e_per_count +
                       c.noise[1].read_noise_counts * c.noise[1].read_noise_counts) /
                      (g * g));
    departure.x.push_back(y);
    departure.y.push_back(-100.0 * c.response[0].log_ratio_at(y));
  }
  noise.series.push_back(model);
  write_plot(noise, stem + "_noise.png");
  Plot linearity{"Linearity: blocks of the flats around the curve",
                 {"signal [counts]"},
                 {"recorded against light [%]"},
                 {}};
  PlotSeries blocks{"blocks", PlotSeries::Style::kPoints, {}, {}};
  for (std::size_t i = 0; i < result.curves.counts.size(); ++i) {
    const double y = result.curves.counts[i];
    blocks.x.push_back(y);
    blocks.y.push_back(100.0 *
                       (result.curves.relative_residual[i] - c.response[0].log_ratio_at(y)));
  }
  linearity.series = {blocks, departure};
  write_plot(linearity, stem + "_linearity.png");
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
      draw_radiance(result, stem.replace_extension().string());
      if (!context.quiet) context.out << radiance_table(result.calibration);
      for (const RadianceResidual& r : result.calibration.residuals) {
        if (r.rms > r.limit) return 1;
      }
      return 0;
    };
  });
}

}  // namespace scattermeter::apps
