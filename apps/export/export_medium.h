// Scattering coefficients of a measured material for a chosen g.
#pragma once

#include <algorithm>
#include <array>

#include "apps/export/export_formats.h"
#include "core/material/scattering_medium.h"

namespace scattermeter::apps {

// One value for each channel R, G, B.
struct ExportMedium {
  std::array<double, 3> sigma_s{}, sigma_a{}, sigma_t{};  // per mm; sigma_s for the options' g
  std::array<double, 3> albedo{};                         // sigma_s / sigma_t
  double largest_sigma_t = 0;
};

inline ExportMedium export_medium(const MeasuredMaterial& material, const ExportOptions& options) {
  ExportMedium out;
  for (std::size_t c = 0; c < 3; ++c) {
    const ScatteringMedium m = scattering_medium(material.rgb[c].medium(), options.g);
    out.sigma_s[c] = m.sigma_s_per_mm;
    out.sigma_a[c] = m.sigma_a_per_mm;
    out.sigma_t[c] = m.sigma_t_per_mm();
    out.albedo[c] = m.albedo();
    out.largest_sigma_t = std::max(out.largest_sigma_t, out.sigma_t[c]);
  }
  return out;
}

}  // namespace scattermeter::apps
