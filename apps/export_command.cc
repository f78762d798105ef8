#include <memory>
#include <ostream>

#include "apps/commands.h"
#include "apps/export_formats.h"
#include "apps/result_json.h"

namespace scattermeter::apps {
namespace {

struct FormatEntry {
  const char* name;
  double mm_per_unit;  // where the option is not given
  std::string (*write)(const ReadResult&, const std::vector<MeasuredMaterial>&,
                       const ExportOptions&);
};
constexpr double kMillimetre = 1.0;
constexpr double kMetre = 1000.0;
constexpr FormatEntry kFormats[] = {
    {"mitsuba", kMillimetre, mitsuba_file}, {"pbrt", kMillimetre, pbrt_file},
    {"blender", kMillimetre, blender_file}, {"openpbr", kMillimetre, openpbr_file},
    {"materialx", kMetre, materialx_file},  {"csv", kMillimetre, nullptr}};

}  // namespace

void add_export_command(CLI::App& app, CommandContext& context) {
  struct Options {
    std::string result, format, out;
    std::vector<std::string> materials;
    double mm_per_unit = 0;  // 0: the format's own
    ExportOptions exported;
  };
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "export",
      "Write measured materials as a renderer's material or as a table.\n"
      "A refused channel is not exported: its material fails with exit status 1 and nothing is "
      "written (csv: its row has the verdict and no values). --material chooses the others.");
  command->add_option("RESULT", options->result, "result.json of `measure`")->required();
  std::vector<std::string> names;
  for (const FormatEntry& f : kFormats) names.emplace_back(f.name);
  command
      ->add_option("--format", options->format,
                   "mitsuba: Mitsuba 3 medium (XML); pbrt: pbrt-v4 medium and material; blender: "
                   "script that makes Principled materials; openpbr: OpenPBR surface (MaterialX "
                   "1.39); materialx: physically based nodes; csv: values with uncertainties")
      ->required()
      ->check(CLI::IsMember(names));
  command->add_option("--out", options->out, "the file; replaced where it is there")->required();
  command->add_option("--material", options->materials,
                      "only this material; may be given again (default: all)");
  command
      ->add_option("--mm-per-unit", options->mm_per_unit,
                   "length of a scene unit in mm (default: 1; materialx: 1000, as it counts per "
                   "metre)")
      ->check(CLI::Range(1e-6, 1e9));
  command
      ->add_option(
          "--g", options->exported.g,
          "mean cosine of the phase function, where it is known: sigma_s = sigma_s' / (1 - "
          "g)")
      ->check(CLI::Range(-0.99, 0.99))
      ->capture_default_str();
  command->callback([options, &context] {
    context.chosen = [options, &context] {
      const ReadResult result = read_result(options->result);
      const std::vector<MeasuredMaterial> materials = materials_of(result, options->materials);
      const std::vector<std::string> refused = refusals(materials);
      for (const std::string& line : refused) {
        context.err << "scattermeter: " << options->result << ": " << line << "\n";
      }
      for (const FormatEntry& f : kFormats) {
        if (options->format != f.name) continue;
        ExportOptions exported = options->exported;
        exported.mm_per_unit = options->mm_per_unit > 0.0 ? options->mm_per_unit : f.mm_per_unit;
        if (f.write != nullptr && !refused.empty()) {
          context.err << "scattermeter: nothing is written; --material chooses materials that were "
                         "measured\n";
          return 1;
        }
        write_text_file(options->out, f.write != nullptr ? f.write(result, materials, exported)
                                                         : csv_file(materials));
      }
      if (!context.quiet) context.out << "written: " << options->out << "\n";
      return refused.empty() ? 0 : 1;
    };
  });
}

}  // namespace scattermeter::apps
