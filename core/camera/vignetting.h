// The fall-off of light from the frame's centre towards its corners.
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "core/camera/cfa_samples.h"

namespace scattermeter {

// Share of the light of the frame's centre that reaches a pixel, per colour:
//   V = 1 + sum over k of radial[k-1] s^k + sum over m of map[m] q_m,
// s = u^2 + v^2, u and v the offsets from the centre over the frame's half diagonal,
// q = u, v, u^2 - v^2, u v (the part without rotational symmetry: a tilted lens or an uneven
// filter). Either list may be short or empty. Domain: the frame.
struct Vignetting {
  Eigen::Vector2d center_px = Eigen::Vector2d::Zero();
  double half_diagonal_px = 1;
  std::array<std::vector<double>, kRgb> radial;
  std::array<std::vector<double>, kRgb> map;  // at most kMapTerms

  static constexpr std::size_t kMapTerms = 4;
  bool is_identity() const;
  double share(double x_px, double y_px, std::size_t channel) const;
  // The terms that the coefficients `radial` and `map` multiply: first `n_radial`, then `n_map`.
  static void terms(double u, double v, std::size_t n_radial, std::size_t n_map, double* out);
};

// Centred on a frame, without terms.
Vignetting vignetting_of_frame(int width_px, int height_px);

}  // namespace scattermeter
