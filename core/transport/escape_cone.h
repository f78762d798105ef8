// Light that leaves within a cone around the camera.
#pragma once

#include <vector>

namespace scattermeter {

// An escape of weight w whose direction lies within kHalfAngle of the direction to the camera
// scores
//   pi w / C,  C = ∫ cos Ft(eta, cos) over the directions of that cone that leave the surface:
// in the mean over the surface pi L_o / Ft, averaged over the cone with weights cos Ft. That is l
// toward the camera except for the curvature of l within the cone (second order in its width). The
// score remains bounded even for facets seen at grazing angles.
class EscapeCone {
 public:
  static constexpr double kHalfAngle = 0.3;  // rad
  static constexpr double kCosHalf = 0.955336489125606;

  // eta_int_over_ext > 0.
  explicit EscapeCone(double eta_int_over_ext);

  // C, sr, for 0 <= cosine <= 1 between the surface's normal and the cone's axis; to 1e-3.
  double transmitting_sr(double cosine) const;

 private:
  std::vector<double> sr_;  // at equal steps of the cosine
};

}  // namespace scattermeter
