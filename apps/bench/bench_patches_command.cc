#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "apps/bench/bench_command.h"
#include "apps/bench/bench_patches.h"
#include "apps/rig/open_objects.h"
#include "apps/simulation/bodies_rig.h"
#include "apps/simulation/plastics_rig.h"
#include "apps/simulation/pyramid_rig.h"
#include "core/light/sky_probe.h"

namespace scattermeter::apps {

void add_patches_bench(CLI::App& bench, CommandContext& context, const SharedBenchOptions& common) {
  struct Options {
    PatchesBenchOptions bench;
    std::string rig;
    std::vector<std::string> scenes = {"sky", "LEDs", "plastics"};
  };
  const auto options = std::make_shared<Options>();
  CLI::App* command = bench.add_subcommand(
      "patches",
      "Effect of the patch size alone on the estimates, for ideal samples (no noise, no rounding) "
      "and "
      "an exact scale.\n"
      "patches.csv: scene, material, channel, patch_mm, rows (patches used), samples_per_patch (of "
      "the channel), *_error (estimate / truth - 1), *_std (stated, relative to the truth), "
      "psnr_db "
      "of the re-rendering, seconds (all channels of the scene), refusal.");
  command->add_option("--rig", options->rig, "rig file with truth, instead of the scenes");
  command
      ->add_option("--scenes", options->scenes,
                   "without --rig: sky (the pyramid under a sky), LEDs (2.19 / 0.002 per mm, cube "
                   "and pyramid on a pedestal), plastics (PP, PE, POM on the same)")
      ->check(CLI::IsMember({"sky", "LEDs", "plastics"}))
      ->capture_default_str();
  command->add_option("--sizes", options->bench.sizes_mm, "patch sizes, mm")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  run_if_named(*command, context, [options, common, &context] {
    options->bench.progress = context.progress;
    const auto wanted = [&](const std::string& name) {
      return std::find(options->scenes.begin(), options->scenes.end(), name) !=
             options->scenes.end();
    };
    const int width_px = common->image_width_px.value_or(3872);
    std::vector<PatchesBenchRow> rows;
    const auto add = [&](const std::string& name, const Rig& rig, const ObjectScenes& objects) {
      const std::vector<PatchesBenchRow> more = bench_patches(name, rig, objects, options->bench);
      rows.insert(rows.end(), more.begin(), more.end());
    };
    if (options->rig.empty()) {
      if (wanted("sky")) {
        const Rig sky =
            pyramid_rig(width_px, std::make_shared<const Environment>(make_sky_probe()));
        add("sky", sky, pyramid_scenes(sky));
      }
      if (wanted("LEDs")) {
        const Medium medium{2.19, 0.002, 1.0};
        const Rig leds = bodies_rig(width_px, 1.3, {{"paper", {medium, medium, medium}}});
        add("LEDs", leds, bodies_scenes(leds));
      }
      if (wanted("plastics")) {
        const Rig plastics = plastics_rig(width_px);
        add("plastics", plastics, bodies_scenes(plastics));
      }
    } else {
      Rig rig = read_rig(options->rig);
      rig.scene.camera.responsivity_relative_std = 0.0;
      add("rig", rig, open_objects(rig));
    }
    BenchFiles files(*common, context);
    files.table(patches_bench_table(rows));
    files.csv("patches", patches_bench_csv(rows));
    return 0;
  });
}

}  // namespace scattermeter::apps
