#include <algorithm>
#include <array>
#include <fstream>
#include <memory>
#include <ostream>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "apps/commands/commands.h"
#include "apps/export/export_formats.h"
#include "capture/files/pending_file.h"
#include "core/base/input_error.h"

namespace scattermeter::apps {
namespace {

// Throws InputError if there is a file that no export wrote: a rig, a mesh, a raw.
void require_export(const std::string& path) {
  constexpr std::array<std::string_view, 3> kBegins = {"<?xml", "# Measured by scattermeter",
                                                       "material,channel,"};
  std::ifstream file(path, std::ios::binary);
  if (!file) return;
  std::string begin(32, '\0');
  file.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  begin.resize(static_cast<std::size_t>(file.gcount()));
  const auto has = [&](std::string_view b) { return begin.starts_with(b); };
  if (begin.empty() || std::ranges::any_of(kBegins, has)) return;
  throw InputError("--out", path + " exists and was not written by `export`: choose another name");
}

}  // namespace

void add_export_command(CLI::App& app, CommandContext& context) {
  struct Options {
    std::string result, format, out;
    std::vector<std::string> materials;
    ExportOptions exported{.mm_per_unit = 0};  // 0: the default of the format
  };
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "export",
      "Write measured materials as a renderer's material or as a table.\n"
      "Refused channels are not exported: if there is one, nothing is written and the exit status "
      "is "
      "1 (csv: its row has the verdict and no values). --material selects the other materials.");
  command->add_option("RESULT", options->result, "result.json of `measure`")->required();
  std::vector<std::string> names, descriptions;
  for (const ExportFormat& f : kExportFormats) {
    names.emplace_back(f.name);
    descriptions.push_back(fmt::format("{}: {}", f.name, f.description));
  }
  command->add_option("--format", options->format, fmt::format("{}", fmt::join(descriptions, "; ")))
      ->required()
      ->check(CLI::IsMember(names));
  command->add_option("--out", options->out, "file to write; an earlier export is replaced")
      ->required();
  command->add_option("--material", options->materials,
                      "only this material; may be repeated (default: all)");
  command
      ->add_option(
          "--mm-per-unit", options->exported.mm_per_unit,
          "length of a scene unit in mm (default: 1; blender and materialx: 1000, as their "
          "unit is the metre)")
      ->check(CLI::Range(1e-6, 1e9));
  command
      ->add_option(
          "--g", options->exported.g,
          "mean cosine of the phase function, if it is known: sigma_s = sigma_s' / (1 - g)")
      ->check(CLI::Range(-0.99, 0.99))
      ->capture_default_str();
  run_if_named(*command, context, [options, &context] {
    capture::require_output_file(options->out, {options->result});
    require_export(options->out);
    const ReadResult result = read_result(options->result);
    const std::vector<MeasuredMaterial> materials = materials_of(result, options->materials);
    const std::vector<std::string> refused = refusals(materials);
    for (const std::string& line : refused) {
      context.err << "scattermeter: " << options->result << ": " << line << "\n";
    }
    const ExportFormat& format =
        *std::ranges::find(kExportFormats, options->format,
                           [](const ExportFormat& f) { return std::string_view(f.name); });
    if (!format.takes_refused && !refused.empty()) {
      context.err << "scattermeter: nothing is written; select measured materials by --material\n";
      return 1;
    }
    ExportOptions exported = options->exported;
    if (exported.mm_per_unit == 0.0) exported.mm_per_unit = format.mm_per_unit;
    capture::write_text_file(options->out, format.text(result, materials, exported));
    if (!context.quiet) context.out << "written: " << options->out << "\n";
    return refused.empty() ? 0 : 1;
  });
}

}  // namespace scattermeter::apps
