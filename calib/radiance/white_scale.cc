#include "calib/radiance/white_scale.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace scattermeter::calib {

double white_radiance_per_intensity(const Led& led, const Eigen::Vector3d& point_mm,
                                    const Eigen::Vector3d& normal) {
  const Eigen::Vector3d to_led_mm = led.position_mm - point_mm;
  const double r2 = to_led_mm.squaredNorm();
  const Eigen::Vector3d w = to_led_mm / std::sqrt(r2);
  const double cosine = normal.dot(w);
  if (!(cosine > 0.0)) return 0.0;
  return led.lobe(-w) * cosine / (std::numbers::pi * r2);
}

double white_weight(const WhiteSum& shot) {
  if (!(shot.counts_per_s > 0.0) || !(shot.radiance > 0.0)) return 0.0;
  const double variance = shot.variance / (shot.counts_per_s * shot.counts_per_s) +
                          shot.relative_std * shot.relative_std;
  return 1.0 / std::max(variance, 1e-16);
}

WhiteScale fit_white_scale(const std::vector<WhiteSum>& shots) {
  WhiteScale out;
  double weight = 0, sum = 0;
  for (const WhiteSum& s : shots) {
    const double w = white_weight(s);
    if (!(w > 0.0)) continue;
    weight += w;
    sum += w * std::log(s.counts_per_s / s.radiance);
  }
  if (!(weight > 0.0)) return out;
  out.responsivity = std::exp(sum / weight);
  out.relative_std = std::sqrt(1.0 / weight);
  for (const WhiteSum& s : shots) {
    if (!(white_weight(s) > 0.0)) continue;
    out.worst = std::max(out.worst, std::abs(s.counts_per_s / s.radiance / out.responsivity - 1.0));
  }
  out.ok = true;
  return out;
}

}  // namespace scattermeter::calib
