#include <array>
#include <cstdint>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "apps/commands/commands.h"
#include "apps/export/identifiers.h"
#include "apps/export/xml_text.h"
#include "apps/report/csv.h"
#include "apps/report/render_pictures.h"
#include "apps/simulation/render.h"
#include "capture/files/exr_file.h"
#include "capture/files/pending_file.h"

namespace scattermeter::apps {
namespace {

struct RenderArguments {
  std::string rig, result, out = "render", model = "dipole";
  std::vector<std::string> materials;
  RenderOptions options;
};

// Writes an EXR and a PNG of each picture, the sheet, and the table that describes them.
void write_rendering(const Rendering& rendering, const std::vector<MeasuredMaterial>& materials,
                     const std::string& model, const std::string& folder) {
  const double white = white_radiance(rendering);
  std::vector<std::string> names;
  for (const RenderedPicture& p : rendering.pictures) {
    const RenderScene& scene = rendering.scenes[p.scene_idx];
    names.push_back(fmt::format("{}_{}_{}", scene.object, fmt::join(scene.lights, "_"),
                                materials[p.material_idx].name));
  }
  names = identifiers(names);
  Csv csv({"picture", "object", "lights", "material", "model", "eta", "sigma_s_prime_per_mm",
           "sigma_a_per_mm", "x0_px", "y0_px", "width_px", "height_px", "exr_unit",
           "white_W_per_mm2_sr", "png_tone", "monte_carlo_std_relative"});
  for (std::size_t i = 0; i < names.size(); ++i) {
    const RenderedPicture& p = rendering.pictures[i];
    const RenderScene& scene = rendering.scenes[p.scene_idx];
    const MeasuredMaterial& m = materials[p.material_idx];
    const std::string unit = "W/(mm^2 sr)";
    const std::string tone = "sRGB of radiance / white, cut at 1";
    const std::string path = folder + "/" + names[i];
    const ColourRadiance& r = p.radiance;
    capture::write_text_file(path + ".exr",
                             capture::encode_exr({r.width, r.height, r.rgb},
                                                 {{"unit", unit},
                                                  {"material", m.name},
                                                  {"model", model},
                                                  {"white_W_per_mm2_sr", csv_number(white)}}));
    capture::write_text_file(path + ".png", png_bytes(srgb_picture(r, white)));
    std::array<double, 3> sigma_s_prime{}, sigma_a{};
    for (std::size_t c = 0; c < 3; ++c) {
      sigma_s_prime[c] = m.rgb[c].sigma_s_prime_per_mm.value;
      sigma_a[c] = m.rgb[c].sigma_a_per_mm.value;
    }
    csv.add_row({names[i], scene.object, fmt::format("{}", fmt::join(scene.lights, " ")), m.name,
                 model, csv_number(m.eta_int_over_ext), rgb_list(sigma_s_prime, " "),
                 rgb_list(sigma_a, " "), std::to_string(r.x0), std::to_string(r.y0),
                 std::to_string(r.width), std::to_string(r.height), unit, csv_number(white), tone,
                 model == "transport" ? csv_number(p.monte_carlo_std) : ""});
  }
  capture::write_text_file(folder + "/sheet.png",
                           png_bytes(contact_sheet(rendering, names_of(materials), white)));
  capture::write_text_file(folder + "/pictures.csv", csv.text());
}

void declare_options(CLI::App& command, RenderArguments& a) {
  command
      .add_option("RIG", a.rig,
                  "rig file (YAML); of its truth, only truth.pose is used, if present")
      ->required();
  command.add_option("--result", a.result, "result.json of `measure`")->required();
  command.add_option("--out", a.out, "folder for the pictures; created if missing")
      ->capture_default_str();
  command
      .add_option("--model", a.model,
                  "dipole: fast, ignores the shape of the body; transport: volumetric Monte Carlo "
                  "in the actual shape")
      ->check(CLI::IsMember({"dipole", "transport"}))
      ->capture_default_str();
  command.add_option("--material", a.materials,
                     "only this material; may be repeated (default: all)");
  command.add_option("--object", a.options.objects,
                     "only this object of the rig; may be repeated (default: those of its shots)");
  command.add_option("--light", a.options.lights,
                     "this light of the rig; if repeated, they are on together (default: as the "
                     "rig's shots are lit)");
  command.add_option("--width", a.options.width_px, "pixels across the frame (default: the rig's)")
      ->check(CLI::Range(16, 100'000));
  command
      .add_option("--paths", a.options.transport.paths,
                  "transport: light paths for each light and channel of a picture; the noise is "
                  "inversely proportional to their square root")
      ->check(CLI::Range(std::int64_t{64}, std::int64_t{1'000'000'000'000}))
      ->capture_default_str();
  command.add_option("--seed", a.options.transport.seed, "transport: seed of the Monte Carlo")
      ->capture_default_str();
}

int run_render(const RenderArguments& a, CommandContext& context) {
  capture::require_output_folder(a.out);
  RenderOptions options = a.options;
  options.transport.volume = a.model == "transport";
  options.progress = context.progress;
  options.transport.peers = context.peers;
  const Rig rig = read_rig(a.rig, false);
  std::vector<MeasuredMaterial> materials = materials_of(read_result(a.result), a.materials);
  const std::vector<std::string> refused = refusals(materials);
  for (const std::string& line : refused) {
    context.err << "scattermeter: " << a.result << ": " << line << "; left out\n";
  }
  std::erase_if(materials, [](const MeasuredMaterial& m) { return m.refused(); });
  if (materials.empty()) {
    context.err << "scattermeter: " << a.result << ": nothing is left to render\n";
    return 1;
  }
  const Rendering rendering = render(rig, materials, options);
  if (context.peers != nullptr && context.peers->rank() > 0) return 0;
  write_rendering(rendering, materials, a.model, a.out);
  if (!context.quiet) {
    context.out << rendering.pictures.size() << " pictures (EXR and PNG), sheet.png and "
                << "pictures.csv written to " << a.out << "\n";
    if (options.transport.volume) {
      context.out << fmt::format(
          "Monte Carlo error of the light of a patch: {:.2g} % (median over the patches, of the "
          "worst picture and channel)\n",
          100.0 * rendering.pictures.back().monte_carlo_std);
    }
  }
  return refused.empty() ? 0 : 1;
}

}  // namespace

void add_render_command(CLI::App& app, CommandContext& context) {
  CLI::App* command = app.add_subcommand(
      "render",
      "Show measured materials on the objects of a rig, under its lights.\n"
      "Every combination of object and lights in the rig's shots is rendered with every material "
      "of the result. OUT receives an OpenEXR (linear radiance, W/(mm^2 sr)) and a PNG (sRGB, one "
      "exposure for all) of each, sheet.png with all of them side by side, and pictures.csv, which "
      "describes them.\n"
      "Exit status: 0 all rendered, 1 a refused material was left out, 2 bad input.");
  const auto arguments = std::make_shared<RenderArguments>();
  declare_options(*command, *arguments);
  run_if_named(
      *command, context, [arguments, &context] { return run_render(*arguments, context); }, true);
}

}  // namespace scattermeter::apps
