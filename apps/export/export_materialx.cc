#include "apps/export/colour_notes.h"
#include "apps/export/export_formats.h"
#include "apps/export/export_medium.h"
#include "apps/export/export_notes.h"
#include "apps/export/identifiers.h"
#include "apps/export/xml_text.h"
#include "apps/pages/html_page.h"
#include "apps/report/csv.h"

namespace scattermeter::apps {
namespace {

std::string input(const std::string& name, const std::string& type, const std::string& value) {
  return xml_value("    ", "input", name, type, value);
}

std::string connection(const std::string& name, const std::string& type, const std::string& node) {
  return "    <input name=\"" + name + "\" type=\"" + type + "\" nodename=\"" + node + "\"/>\n";
}

// The colours are linear; lin_rec709 keeps a renderer from converting them.
std::string document(const std::string& version, const std::string& comments,
                     const std::string& body) {
  return "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n" + comments + "<materialx version=\"" +
         version + "\" colorspace=\"lin_rec709\">\n" + body + "</materialx>\n";
}

// The user's name of the material goes into `uiname`, the attribute that MaterialX has for it.
std::string material_node(const std::string& id, const std::string& name) {
  return "  <surfacematerial name=\"" + id + "\" type=\"material\" uiname=\"" +
         html_text(name).markup + "\">\n" +
         connection("surfaceshader", "surfaceshader", id + "_shader") + "  </surfacematerial>\n";
}

}  // namespace

// In OpenPBR the radius is the mean free path 1 / sigma_t of the medium with its own g. Colour and
// g give the albedo by similarity: van de Hulst's s is that of the reduced material.
std::string openpbr_file(const ReadResult& result, const std::vector<MeasuredMaterial>& materials,
                         const ExportOptions& options) {
  const ColourFit& fit = openpbr_colour();
  std::string body;
  const std::vector<std::string> ids = identifiers(names_of(materials));
  for (std::size_t i = 0; i < materials.size(); ++i) {
    const MeasuredMaterial& m = materials[i];
    const ExportMedium medium = export_medium(m, options);
    const std::array<double, 3> albedo = reduced_albedo(m);
    std::array<double, 3> colour{}, radius{};
    double largest = 0.0;
    for (std::size_t c = 0; c < 3; ++c) {
      colour[c] = fit.colour_of(albedo[c]);
      radius[c] = 1.0 / (medium.sigma_t[c] * options.mm_per_unit);
      largest = std::max(largest, radius[c]);
    }
    for (double& r : radius) r /= largest;
    body += xml_comments(value_notes(m), "  ") + xml_comments(colour_notes(fit, m), "  ");
    body += "  <open_pbr_surface name=\"" + ids[i] + "_shader\" type=\"surfaceshader\">\n";
    body += input("specular_roughness", "float", "0");
    body += input("specular_ior", "float", csv_number(m.eta_int_over_ext));
    body += input("subsurface_weight", "float", "1");
    body += input("subsurface_color", "color3", rgb_list(colour));
    body += input("subsurface_radius", "float", csv_number(largest));
    body += input("subsurface_radius_scale", "color3", rgb_list(radius));
    body += input("subsurface_scatter_anisotropy", "float", csv_number(options.g));
    body += "  </open_pbr_surface>\n" + material_node(ids[i], m.name);
  }
  std::vector<std::string> notes = export_notes(result, options);
  notes.push_back(
      "OpenPBR 1.1 as a MaterialX document: subsurface_radius times subsurface_radius_scale is the "
      "mean free path 1 / sigma_t in scene units. A renderer whose albedo inversion is not that of "
      "the specification derives another sigma_a from the colours.");
  return document("1.39", xml_comments(notes, ""), body);
}

// The specification of the physically based nodes states absorption and scattering per metre.
std::string materialx_file(const ReadResult& result, const std::vector<MeasuredMaterial>& materials,
                           const ExportOptions& options) {
  std::string body;
  const std::vector<std::string> ids = identifiers(names_of(materials));
  for (std::size_t i = 0; i < materials.size(); ++i) {
    const MeasuredMaterial& m = materials[i];
    ExportMedium medium = export_medium(m, options);
    for (double& s : medium.sigma_s) s *= options.mm_per_unit;
    for (double& s : medium.sigma_a) s *= options.mm_per_unit;
    body += xml_comments(value_notes(m), "  ");
    body += "  <dielectric_bsdf name=\"" + ids[i] + "_surface\" type=\"BSDF\">\n";
    body += input("ior", "float", csv_number(m.eta_int_over_ext));
    body += input("roughness", "vector2", "0, 0");
    body += input("scatter_mode", "string", "RT");
    body += "  </dielectric_bsdf>\n";
    body += "  <anisotropic_vdf name=\"" + ids[i] + "_volume\" type=\"VDF\">\n";
    body += input("absorption", "vector3", rgb_list(medium.sigma_a));
    body += input("scattering", "vector3", rgb_list(medium.sigma_s));
    body += input("anisotropy", "float", csv_number(options.g));
    body += "  </anisotropic_vdf>\n";
    body += "  <layer name=\"" + ids[i] + "_body\" type=\"BSDF\">\n";
    body += connection("top", "BSDF", ids[i] + "_surface");
    body += connection("base", "VDF", ids[i] + "_volume");
    body += "  </layer>\n";
    body += "  <surface name=\"" + ids[i] + "_shader\" type=\"surfaceshader\">\n";
    body += connection("bsdf", "BSDF", ids[i] + "_body");
    body += "  </surface>\n" + material_node(ids[i], m.name);
  }
  std::vector<std::string> notes = export_notes(result, options);
  notes.push_back(
      "MaterialX, nodes of the physically based library: absorption and scattering per scene unit, "
      "which its specification assumes to be the metre.");
  return document("1.38", xml_comments(notes, ""), body);
}

}  // namespace scattermeter::apps
