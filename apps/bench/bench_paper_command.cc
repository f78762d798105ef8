#include <utility>

#include "apps/bench/bench_command.h"
#include "apps/bench/bench_paper.h"
#include "capture/files/probe_reader.h"

namespace scattermeter::apps {

void add_paper_bench(CLI::App& bench, CommandContext& context, const SharedBenchOptions& common) {
  struct Options {
    std::string probe;
    ProbeProjection projection = ProbeProjection::kEquirectangular;
    bool noise = false;
  };
  const auto options = std::make_shared<Options>();
  CLI::App* command = bench.add_subcommand(
      "paper",
      "The paper's simulation: a pyramid of 2.19 / 0.002 per mm under a light probe, channel G.\n"
      "Its method at ten quantisation widths (table 2, with the published rows), and the dipole "
      "fitted to r on the same knots.\n"
      "paper.csv: width_mm (none: not quantised); published_*, paper_* (its method, this image) "
      "and "
      "ours_*: sigma_s, sigma_a and their std in 1/mm, psnr_db of the re-rendering, verdict.\n"
      "paper_reflectance.csv: curve (paper: pseudo-inverse at its best width; smooth: without a "
      "model), distance_mm, r_per_mm2, log_std (of r), determined (1: by the image), "
      "truth_per_mm2.");
  command->add_option("--probe", options->probe,
                      "light probe, .hdr or .exr (default: a computed sky with sun)");
  add_named_option(*command, "--projection", options->projection,
                   {{"equirectangular", ProbeProjection::kEquirectangular},
                    {"angular_map", ProbeProjection::kAngularMap},
                    {"mirror_ball", ProbeProjection::kMirrorBall}},
                   "projection of the probe");
  add_named_option(*command, "--noise", options->noise, {{"on", true}, {"off", false}},
                   "on: one 12-bit exposure with noise; off: ideal samples");
  run_if_named(*command, context, [options, common, &context] {
    PaperBenchOptions bench_options;
    take_common(*common, context, bench_options);
    bench_options.noise = options->noise;
    if (!options->probe.empty()) {
      capture::ProbeImage image = capture::read_probe(options->probe);
      auto probe = std::make_shared<Environment>();
      probe->width_px = image.width_px;
      probe->height_px = image.height_px;
      probe->radiance = std::move(image.radiance);
      probe->projection = options->projection;
      bench_options.probe = std::move(probe);
    }
    const PaperBench result = bench_paper(bench_options);
    BenchFiles files(*common, context);
    files.table(paper_bench_table(result));
    files.csv("paper", paper_bench_csv(result));
    files.csv("paper_reflectance", paper_reflectance_csv(result));
    files.plot("paper_psnr", paper_psnr_plot(result));
    files.plot("paper_reflectance", paper_reflectance_plot(result));
    files.plot("paper_reflectance_ratio", paper_reflectance_ratio_plot(result));
    files.plot("paper_absorption", paper_absorption_plot(result));
    return 0;
  });
}

}  // namespace scattermeter::apps
