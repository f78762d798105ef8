#include "apps/export/colour_notes.h"

#include <fmt/core.h>

#include "core/material/half_space_albedo.h"

namespace scattermeter::apps {

std::array<double, 3> reduced_albedo(const MeasuredMaterial& material) {
  std::array<double, 3> out{};
  for (std::size_t c = 0; c < 3; ++c) {
    const Medium m = material.rgb[c].medium();
    out[c] = m.sigma_s_prime_per_mm / m.sigma_t_prime_per_mm();
  }
  return out;
}

std::vector<std::string> colour_notes(const ColourFit& fit, const MeasuredMaterial& material) {
  std::vector<std::string> notes = {"Colour from albedo by " + fit.source + "."};
  const std::array<double, 3> albedo = reduced_albedo(material);
  for (std::size_t c = 0; c < 3; ++c) {
    const double colour = fit.colour_of(albedo[c]);
    const Medium m = material.rgb[c].medium();
    const double read_back = (1.0 - fit.albedo_of(colour)) * m.sigma_t_prime_per_mm();
    notes.push_back(fmt::format(
        "{}: albedo {:.8f}, colour {:.6f}; an index-matched half-space reflects {:.6f} (error of "
        "the fit {:+.2g}, which changes the colour and not the material: the renderer converts the "
        "colour to sigma_a = {:.6g} per mm)",
        "RGB"[c], albedo[c], colour, half_space_albedo(albedo[c]), colour_error(fit, albedo[c]),
        read_back));
  }
  return notes;
}

}  // namespace scattermeter::apps
