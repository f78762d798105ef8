#include <fmt/core.h>

#include "apps/export/colour_notes.h"
#include "apps/export/export_formats.h"
#include "apps/export/export_notes.h"
#include "apps/export/xml_text.h"
#include "apps/report/csv.h"
#include "core/base/input_error.h"

namespace scattermeter::apps {
namespace {

// A Python string literal, in UTF-8 like result.json.
std::string python_text(const std::string& text) {
  std::string out = "\"";
  for (char c : text) {
    if (c == '"' || c == '\\') {
      out += std::string("\\") + c;
    } else if (static_cast<unsigned char>(c) < 0x20U || c == '\x7f') {
      out += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
    } else {
      out += c;
    }
  }
  return out + "\"";
}

std::string python_comments(const std::vector<std::string>& lines) {
  std::string out;
  for (const std::string& line : lines) out += "# " + line + "\n";
  return out;
}

constexpr const char* kScript = R"py(

def make(material):
    made = bpy.data.materials.new(material["name"])
    made.use_nodes = True
    node = next(n for n in made.node_tree.nodes if n.type == "BSDF_PRINCIPLED")
    node.subsurface_method = "RANDOM_WALK"
    node.inputs["Base Color"].default_value = (*material["base_color"], 1.0)
    node.inputs["Roughness"].default_value = 0.0
    node.inputs["IOR"].default_value = material["ior"]
    node.inputs["Subsurface Weight"].default_value = 1.0
    node.inputs["Subsurface Radius"].default_value = material["radius_mm"]
    node.inputs["Subsurface Scale"].default_value = 1.0 / MM_PER_UNIT
    node.inputs["Subsurface Anisotropy"].default_value = 0.0
    return made


for material in MATERIALS:
    make(material)
)py";

}  // namespace

std::string blender_file(const ReadResult& result, const std::vector<MeasuredMaterial>& materials,
                         const ExportOptions& options) {
  if (options.g != 0.0) {
    throw InputError("--g",
                     fmt::format("the format blender takes 0 only, got {}: its colour describes "
                                 "an isotropic material",
                                 options.g));
  }
  const ColourFit& fit = cycles_colour();
  std::string out = python_comments(export_notes(result, options));
  out += python_comments(
      {"Blender 4.0 and later, renderer Cycles: open in the Text Editor and run; it adds a "
       "material "
       "of each name. A unit of Blender's own scene is 1 m; for a scene whose lengths are in mm, "
       "such as a mesh in mm imported as it stands, export with --mm-per-unit 1.",
       "radius_mm = 4 pi / sigma_t': Cycles' Random Walk takes radius / (4 pi) as the mean free "
       "path (kernel/closure/bssrdf.h). Light enters diffusely and leaves without refraction: the "
       "interior is the measured one, the smooth surface is an approximation."});
  out += "import bpy\n\nMM_PER_UNIT = " + csv_number(options.mm_per_unit) + "\nMATERIALS = [\n";
  for (const MeasuredMaterial& m : materials) {
    const std::array<double, 3> albedo = reduced_albedo(m);
    std::array<double, 3> colour{}, radius_mm{};
    for (std::size_t c = 0; c < 3; ++c) {
      colour[c] = fit.colour_of(albedo[c]);
      radius_mm[c] = cycles_radius_over_mean_free_path() / m.rgb[c].medium().sigma_t_prime_per_mm();
    }
    out += python_comments(value_notes(m)) + python_comments(colour_notes(fit, m));
    out += fmt::format(
        "    {{\"name\": {}, \"base_color\": [{}], \"radius_mm\": [{}], \"ior\": {}}},\n",
        python_text(m.name), rgb_list(colour), rgb_list(radius_mm), csv_number(m.eta_int_over_ext));
  }
  return out + "]\n" + kScript;
}

}  // namespace scattermeter::apps
