// Light that leaves within a cone around the camera.
#pragma once

#include <optional>

#include "core/material/cosine_table.h"

namespace scattermeter {

// An escape of weight w whose direction lies within kHalfAngle of the direction to the camera
// scores
//   pi w / C,  C = ∫ cos Ft(eta, cos) over the directions of that cone that leave the surface:
// in the mean over the surface pi L_o / Ft, averaged over the cone with weights cos Ft. That is l
// toward the camera except for the curvature of l within the cone (second order in its width). The
// score remains bounded even for facets seen at grazing angles.
//
// Of a rough boundary, light leaves in proportion to its transmittance T, while l is pi L_o / Ft:
//   C = Ft / T (axis) * ∫ cos T(cos).
// Light that leaves by several of its microfacets goes everywhere, with a transmittance T of its
// own, and is scored within kWideHalfAngle: in the narrow cone, it is the larger part of the noise.
class EscapeCone {
 public:
  static constexpr double kHalfAngle = 0.3;  // rad
  static constexpr double kCosHalf = 0.955336489125606;
  static constexpr double kWideHalfAngle = 0.9;  // rad
  static constexpr double kCosWideHalf = 0.621609968270664;

  // eta_int_over_ext > 0; surface_alpha as in ScatteringMedium.
  explicit EscapeCone(double eta_int_over_ext, double surface_alpha = 0.0);

  // C, sr, for 0 <= cosine <= 1 between the surface's normal and the cone's axis; to 1e-3.
  double transmitting_sr(double cosine) const { return (*sr_)(cosine); }
  // The same for light that leaves a rough boundary by several microfacets.
  double transmitting_by_several_sr(double cosine) const { return (*by_several_sr_)(cosine); }

 private:
  std::optional<CosineTable> sr_, by_several_sr_;
};

}  // namespace scattermeter
