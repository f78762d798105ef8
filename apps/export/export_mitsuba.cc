#include "apps/export/export_formats.h"
#include "apps/export/export_medium.h"
#include "apps/export/export_notes.h"
#include "apps/export/identifiers.h"
#include "apps/export/xml_text.h"
#include "apps/report/csv.h"

namespace scattermeter::apps {

// RGB values in Mitsuba lie in 0 .. 1, so sigma_t is divided by its largest channel, which goes
// into `scale` together with the unit of length.
std::string mitsuba_file(const ReadResult& result, const std::vector<MeasuredMaterial>& materials,
                         const ExportOptions& options) {
  std::string out = "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n";
  out += xml_comments(export_notes(result, options), "");
  out += xml_comments(
      {"Mitsuba 3: include this file, then give a closed mesh the medium as its interior and the "
       "dielectric as its bsdf; integrator volpath. scale is the largest sigma_t per scene unit "
       "and "
       "multiplies sigma_t.",
       "Use: <shape type=\"obj\"> ... <ref id=\"NAME_surface\"/> <ref name=\"interior\" "
       "id=\"NAME\"/> </shape>"},
      "");
  out += "<scene version=\"3.0.0\">\n";
  const std::vector<std::string> ids = identifiers(names_of(materials));
  for (std::size_t i = 0; i < materials.size(); ++i) {
    const MeasuredMaterial& m = materials[i];
    const ExportMedium medium = export_medium(m, options);
    std::array<double, 3> relative{};
    for (std::size_t c = 0; c < 3; ++c) relative[c] = medium.sigma_t[c] / medium.largest_sigma_t;
    out += xml_comments(value_notes(m), "  ");
    out += "  <medium type=\"homogeneous\" id=\"" + ids[i] + "\">\n";
    out += xml_value("    ", "rgb", "sigma_t", "", rgb_list(relative));
    out += xml_value("    ", "rgb", "albedo", "", rgb_list(medium.albedo));
    out += xml_value("    ", "float", "scale", "",
                     csv_number(medium.largest_sigma_t * options.mm_per_unit));
    if (options.g == 0.0) {
      out += "    <phase type=\"isotropic\"/>\n";
    } else {
      out += "    <phase type=\"hg\">\n";
      out += xml_value("      ", "float", "g", "", csv_number(options.g));
      out += "    </phase>\n";
    }
    out += "  </medium>\n";
    out += "  <bsdf type=\"dielectric\" id=\"" + ids[i] + "_surface\">\n";
    out += xml_value("    ", "float", "int_ior", "", csv_number(m.eta_int_over_ext));
    out += xml_value("    ", "float", "ext_ior", "", "1");
    out += "  </bsdf>\n";
  }
  return out + "</scene>\n";
}

}  // namespace scattermeter::apps
