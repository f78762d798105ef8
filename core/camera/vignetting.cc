#include "core/camera/vignetting.h"

#include <cmath>

namespace scattermeter {

bool Vignetting::is_identity() const {
  for (std::size_t c = 0; c < kRgb; ++c) {
    if (!radial[c].empty() || !map[c].empty()) return false;
  }
  return true;
}

void Vignetting::terms(double u, double v, std::size_t n_radial, std::size_t n_map, double* out) {
  const double s = u * u + v * v;
  double power = 1.0;
  for (std::size_t k = 0; k < n_radial; ++k) *out++ = power *= s;
  const std::array<double, kMapTerms> q = {u, v, u * u - v * v, u * v};
  for (std::size_t m = 0; m < n_map; ++m) *out++ = q[m];
}

double Vignetting::share(double x_px, double y_px, std::size_t channel) const {
  const double u = (x_px - center_px.x()) / half_diagonal_px;
  const double v = (y_px - center_px.y()) / half_diagonal_px;
  const double s = u * u + v * v;
  double sum = 0.0;
  for (std::size_t k = radial[channel].size(); k-- > 0;) sum = (sum + radial[channel][k]) * s;
  const std::array<double, kMapTerms> q = {u, v, u * u - v * v, u * v};
  for (std::size_t m = 0; m < map[channel].size(); ++m) sum += map[channel][m] * q[m];
  return 1.0 + sum;
}

Vignetting vignetting_of_frame(int width_px, int height_px) {
  Vignetting out;
  out.center_px = {0.5 * (width_px - 1), 0.5 * (height_px - 1)};
  out.half_diagonal_px = 0.5 * std::hypot(width_px, height_px);
  return out;
}

}  // namespace scattermeter
