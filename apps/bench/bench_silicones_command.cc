#include <memory>
#include <string>
#include <vector>

#include "apps/bench/bench_command.h"
#include "apps/deviations/silicones_report.h"
#include "capture/files/pending_file.h"

namespace scattermeter::apps {

void add_silicones_bench(CLI::App& bench, CommandContext& context,
                         const SharedBenchOptions& common) {
  const auto options = std::make_shared<SiliconeOptions>();
  CLI::App* command = bench.add_subcommand(
      "silicones",
      "The published experiment with silicones (Hevisov, Foschum and Kienle, Photonics 2025, 12, "
      "1118): three of them, a cube and a bust, from one image and from three, rendered by volume "
      "and measured by transport, on rigs whose errors are drawn from what they state; the rig is "
      "silent about the phase function and the table. Prints the answers, and the errors beside "
      "the published ones; takes some minutes for each.\n"
      "silicones.csv: body, images, silicone, draw, channel, verdict, coefficients with their "
      "standard deviations, intervals_holding (of the two 95 % intervals), colour_difference "
      "(CIEDE2000 of the re-rendering, mean of the lit pixels), seconds, reasons.");
  command->add_option("--draws", options->draws, "rigs for each silicone and body")
      ->check(CLI::Range(1, 10'000))
      ->capture_default_str();
  command->add_option("--body", options->bodies, "only this body (may be repeated)")
      ->check(CLI::IsMember({"cube", "bust"}));
  std::vector<std::string> names;
  for (const Silicone& silicone : silicones()) names.emplace_back(silicone.name);
  command->add_option("--silicone", options->silicones, "only this silicone (may be repeated)")
      ->check(CLI::IsMember(names));
  command->add_option("--images", options->images, "only this number of images (may be repeated)")
      ->check(CLI::Range(1, 3));
  command
      ->add_option("--rendered-paths", options->rendered_paths,
                   "light paths of a rendering, for each light and channel")
      ->check(CLI::Range(std::int64_t{10'000}, std::int64_t{1'000'000'000'000}))
      ->capture_default_str();
  command
      ->add_option("--measured-paths", options->measured_paths,
                   "most light paths of measuring, for each light and view")
      ->check(CLI::Range(std::int64_t{300'000}, std::int64_t{1'000'000'000'000}))
      ->capture_default_str();
  run_if_named(*command, context, [options, common, &context] {
    take_common(*common, context, *options);
    std::vector<SiliconeResult> so_far;
    options->on_result = [&](const SiliconeResult& result) {
      so_far.push_back(result);
      // A run takes hours: what is known is kept.
      capture::write_text_file(common->out + "/silicones.csv", silicones_csv(so_far));
    };
    const std::vector<SiliconeResult> results = bench_silicones(*options);
    BenchFiles files(*common, context);
    files.table(silicones_table(results) + "\n" + silicones_summary_table(results));
    files.csv("silicones", silicones_csv(results));
    return 0;
  });
}

}  // namespace scattermeter::apps
