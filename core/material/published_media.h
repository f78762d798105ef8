// Published coefficients of well-known materials.
#pragma once

#include <array>
#include <span>
#include <string_view>

namespace scattermeter {

// Coefficients in the channels R, G, B of the authors' camera, 1/mm; they state no uncertainties.
struct PublishedMaterial {
  std::string_view name;
  std::array<double, 3> sigma_s_prime_per_mm;
  std::array<double, 3> sigma_a_per_mm;
  double eta_int_over_ext;
};

// Jensen, Marschner, Levoy and Hanrahan, "A practical model for subsurface light transport" (2001),
// figure 5: twelve materials, in the order of their names.
std::span<const PublishedMaterial> published_materials();

}  // namespace scattermeter
