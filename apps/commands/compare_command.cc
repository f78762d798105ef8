#include <algorithm>
#include <memory>
#include <ostream>

#include "apps/commands/commands.h"
#include "apps/report/comparison_table.h"
#include "apps/results/comparison.h"

namespace scattermeter::apps {

void add_compare_command(CLI::App& app, CommandContext& context) {
  struct Options {
    std::string first, second;
    std::vector<std::string> materials;
    bool same_rig = false;
  };
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "compare",
      "Tell whether two results are of the same material.\n"
      "Prints the differences with their standard deviations; what both results owe to one rig "
      "(scale, lens, pose, LEDs, surroundings) is counted once. Refused channels are left out.\n"
      "Exit status: 0 no difference found, 1 at least one material is different, 2 bad input.");
  command->add_option("FIRST", options->first, "result.json of `measure`")->required();
  command->add_option("SECOND", options->second, "another one, or the same")->required();
  command->add_option("--material", options->materials,
                      "only this material, or FIRST=SECOND where the names differ; may be repeated "
                      "(default: all that both hold)");
  command->add_flag("--same-rig", options->same_rig,
                    "the rig files differ only in shots, materials and pieces (default: one rig "
                    "only where the files are equal)");
  run_if_named(*command, context, [options, &context] {
    const ReadResult first = read_result(options->first);
    const ReadResult second = read_result(options->second);
    const bool share_rig = options->same_rig || have_same_rig(first, second);
    const std::vector<MaterialComparison> materials =
        compare(first, second, pairs_of(first, second, options->materials), share_rig);
    if (!context.quiet) {
      context.out << comparison_table(materials)
                  << (share_rig ? "what both owe to their common rig is counted once\n"
                                : "the rigs are taken as independent (--same-rig: they are not)\n");
    }
    return std::any_of(materials.begin(), materials.end(),
                       [](const MaterialComparison& m) { return m.is_different(); })
               ? 1
               : 0;
  });
}

}  // namespace scattermeter::apps
