#include "core/material/subsurface_colour.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/material/half_space_albedo.h"

namespace scattermeter {
namespace {

double van_de_hulst_colour(double albedo) {
  const double s = std::sqrt(std::max(0.0, 1.0 - albedo));
  return (1.0 - s) * (1.0 - 0.139 * s) / (1.0 + 1.17 * s);
}

// The root of 0.139 s^2 - (1.139 + 1.17 C) s + 1 - C = 0 in 0 .. 1. The specification prints it
// with six figures (s = 4.09712 + 4.20863 C - sqrt(9.59217 + 41.6808 C + 17.7126 C^2)); these are
// those of that root.
double van_de_hulst_albedo(double colour) {
  const double half = 0.5 * (1.139 + 1.17 * colour);
  // Of the two ways to write the root, the one without a difference of near numbers.
  const double s = (1.0 - colour) / (half + std::sqrt(half * half - 0.139 * (1.0 - colour)));
  return 1.0 - s * s;
}

double cycles_albedo(double colour) {
  if (!(colour > 0.0)) return 0.0;
  constexpr double kB = 4.98511194385 + 0.127355959438;
  constexpr double kE = 4.23190299701 + 0.00310603949088;
  const double blend = std::pow(colour, 0.25);
  const double low = 1.8260523782 * std::pow(std::atan(kB * colour), 1.09686102424);
  const double high = 0.496310210422 * std::pow(std::atan(kE * colour), 2.40602999408);
  return std::clamp((1.0 - blend) * low + blend * high, 0.0, 0.999999);
}

// The fit grows all the way (test), so halving finds its inverse.
double cycles_inverse(double albedo) {
  double low = 0.0, high = 1.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (cycles_albedo(middle) < albedo ? low : high) = middle;
  }
  return high;
}

}  // namespace

const ColourFit& openpbr_colour() {
  static const ColourFit kFit = {
      "van de Hulst 1980, as in the OpenPBR specification 1.1 (Kulla and Conty 2017): colour = (1 "
      "- "
      "s)(1 - 0.139 s) / (1 + 1.17 s), s = sqrt(1 - albedo)",
      van_de_hulst_albedo, van_de_hulst_colour};
  return kFit;
}

const ColourFit& cycles_colour() {
  static const ColourFit kFit = {
      "Blender Cycles, kernel/integrator/subsurface_random_walk.h (after Chiang, Kutz and Burley "
      "2016; anisotropy 0)",
      cycles_albedo, cycles_inverse};
  return kFit;
}

double colour_error(const ColourFit& fit, double albedo) {
  return fit.colour_of(albedo) - half_space_albedo(albedo);
}

double cycles_radius_over_mean_free_path() { return 4.0 * std::numbers::pi; }

}  // namespace scattermeter
