#include <algorithm>
#include <memory>
#include <optional>
#include <ostream>
#include <utility>

#include "apps/commands/commands.h"
#include "apps/pages/comparison_page.h"
#include "apps/report/comparison_table.h"
#include "apps/results/comparison.h"
#include "apps/results/material_library.h"
#include "capture/files/pending_file.h"

namespace scattermeter::apps {

namespace {

struct CompareArguments {
  std::string first, second, out;
  std::vector<std::string> materials;
  bool same_rig = false;
  std::optional<std::string> library;  // a folder; "": published coefficients alone
};

int compare_two(const CompareArguments& a, const ReadResult& first, CommandContext& context) {
  const ReadResult second = read_result(a.second);
  const bool share_rig = a.same_rig || have_same_rig(first, second);
  const std::vector<MaterialComparison> materials =
      compare(first, second, pairs_of(first, second, a.materials), share_rig);
  const std::string rigs = share_rig
                               ? "what both owe to their common rig is counted once"
                               : "the rigs are taken as independent (--same-rig: they are not)";
  if (!context.quiet) context.out << comparison_table(materials) << rigs << "\n";
  if (!a.out.empty()) {
    const std::string path = a.out + "/compare.html";
    capture::write_text_file(
        path, comparison_page(materials, a.first, a.second, rigs, context.command_line));
    if (!context.quiet) context.out << "written: " << path << "\n";
  }
  return std::any_of(materials.begin(), materials.end(),
                     [](const MaterialComparison& m) { return m.is_different(); })
             ? 1
             : 0;
}

int compare_with_library(const CompareArguments& a, const ReadResult& first,
                         CommandContext& context) {
  std::vector<ReadResult> library = {published_library()};
  if (!a.library->empty()) {
    ResultFolder folder = results_in(*a.library, a.first);
    for (ReadResult& result : folder.results) library.push_back(std::move(result));
    if (!folder.left_out.empty()) {
      context.err << "scattermeter: left out: " << folder.left_out.size()
                  << " JSON files that are no results, " << folder.left_out.front()
                  << (folder.left_out.size() > 1 ? " ...\n" : "\n");
    }
  }
  bool all_known = true;
  for (const std::string& name : a.materials) require_material(first, name);
  for (const std::string& name : a.materials.empty() ? material_names(first) : a.materials) {
    const std::vector<LibraryMatch> found = matches(first, name, library);
    all_known = all_known && !found.empty() && !found.front().comparison.is_different();
    if (!context.quiet) context.out << library_table(name, found);
  }
  if (!context.quiet) {
    context.out << "published coefficients have no stated errors and are taken as "
                << 100.0 * kPublishedStd << " % uncertain; their R, G, B are another camera's\n";
  }
  return all_known ? 0 : 1;
}

}  // namespace

void add_compare_command(CLI::App& app, CommandContext& context) {
  const auto a = std::make_shared<CompareArguments>();
  CLI::App* command = app.add_subcommand(
      "compare",
      "Tell whether two results are of the same material, or which known material one is like.\n"
      "Prints the differences with their standard deviations; what both results owe to one rig "
      "(scale, lens, pose, LEDs, surroundings) is counted once. Refused channels are left out.\n"
      "Exit status: 0 no difference found, 1 at least one material is different (--library: from "
      "all that are known), 2 bad input.");
  command->add_option("FIRST", a->first, "result.json of `measure`")->required();
  CLI::Option* second = command->add_option("SECOND", a->second, "another one, or the same");
  command->add_option("--material", a->materials,
                      "only this material, or FIRST=SECOND where the names differ; may be repeated "
                      "(default: all that both hold)");
  command->add_flag("--same-rig", a->same_rig,
                    "the rig files differ only in shots, materials and pieces (default: one rig "
                    "only where the files are equal)");
  CLI::Option* out = command->add_option("--out", a->out, "folder for a page, compare.html");
  command
      ->add_option_function<std::vector<std::string>>(
          "--library",
          [a](const std::vector<std::string>& folder) {
            a->library = folder.empty() ? "" : folder.front();
          },
          "instead of SECOND: the likest of the twelve materials of Jensen et al. 2001 and, if "
          "a folder is named, of all results below it")
      ->type_name("[FOLDER]")
      ->expected(0, 1)
      ->excludes(second)
      ->excludes(out);
  run_if_named(*command, context, [a, &context] {
    if (a->second.empty() && !a->library) {
      throw InputError("compare", "needs a second result, or --library [FOLDER]");
    }
    if (!a->out.empty()) capture::require_output_folder(a->out);
    const ReadResult first = read_result(a->first);
    return a->library ? compare_with_library(*a, first, context) : compare_two(*a, first, context);
  });
}

}  // namespace scattermeter::apps
