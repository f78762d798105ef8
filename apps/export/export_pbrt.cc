#include <fmt/core.h>

#include "apps/export/export_formats.h"
#include "apps/export/export_medium.h"
#include "apps/export/export_notes.h"
#include "apps/export/identifiers.h"
#include "apps/export/xml_text.h"
#include "apps/report/csv.h"

namespace scattermeter::apps {
namespace {

std::string pbrt_comments(const std::vector<std::string>& lines) {
  std::string out;
  for (const std::string& line : lines) out += "# " + line + "\n";
  return out;
}

}  // namespace

std::string pbrt_file(const ReadResult& result, const std::vector<MeasuredMaterial>& materials,
                      const ExportOptions& options) {
  std::string out = pbrt_comments(export_notes(result, options));
  out += pbrt_comments(
      {"pbrt-v4. sigma_a and sigma_s are per mm; \"scale\" is mm per scene unit.",
       "Exact, integrator volpath: MediumInterface \"NAME\" \"\"  NamedMaterial \"NAME_surface\"  "
       "Shape ...",
       "Approximate, by pbrt's BSSRDF for flat, thick bodies: NamedMaterial \"NAME_subsurface\"  "
       "Shape ..."});
  const std::vector<std::string> ids = identifiers(names_of(materials));
  for (std::size_t i = 0; i < materials.size(); ++i) {
    const MeasuredMaterial& m = materials[i];
    const ExportMedium medium = export_medium(m, options);
    const std::string coefficients = fmt::format(
        "\n  \"rgb sigma_a\" [ {} ]\n  \"rgb sigma_s\" [ {} ]\n  \"float g\" [ {} ] "
        "\"float scale\" [ {} ]",
        rgb_list(medium.sigma_a, " "), rgb_list(medium.sigma_s, " "), csv_number(options.g),
        csv_number(options.mm_per_unit));
    const std::string eta = csv_number(m.eta_int_over_ext);
    out += "\n" + pbrt_comments(value_notes(m));
    out += fmt::format("MakeNamedMedium \"{}\" \"string type\" \"homogeneous\"{}\n", ids[i],
                       coefficients);
    out += fmt::format(
        "MakeNamedMaterial \"{}_surface\" \"string type\" \"dielectric\" \"float eta\" [ {} ]\n",
        ids[i], eta);
    out += fmt::format(
        "MakeNamedMaterial \"{}_subsurface\" \"string type\" \"subsurface\"{} \"float eta\" [ {} "
        "]\n",
        ids[i], coefficients, eta);
  }
  return out;
}

}  // namespace scattermeter::apps
