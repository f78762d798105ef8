#include "core/transport/escape_cone.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "core/material/fresnel.h"

namespace scattermeter {
namespace {

constexpr int kSteps = 64;
constexpr int kRings = 32;
constexpr int kSectors = 64;

}  // namespace

EscapeCone::EscapeCone(double eta_int_over_ext) {
  for (int k = 0; k <= kSteps; ++k) {
    const double cos_axis = static_cast<double>(k) / kSteps;
    const double sin_axis = std::sqrt(1.0 - cos_axis * cos_axis);
    double sum = 0.0;
    // Equal solid angles, by their middles.
    for (int i = 0; i < kRings; ++i) {
      const double c = 1.0 - (1.0 - kCosHalf) * (i + 0.5) / kRings;
      const double s = std::sqrt(1.0 - c * c);
      for (int j = 0; j < kSectors; ++j) {
        const double around = 2.0 * std::numbers::pi * (j + 0.5) / kSectors;
        const double cosine = c * cos_axis + s * sin_axis * std::cos(around);
        if (cosine > 0.0) sum += cosine * fresnel_transmittance(eta_int_over_ext, cosine);
      }
    }
    sr_.push_back(2.0 * std::numbers::pi * (1.0 - kCosHalf) * sum / (kRings * kSectors));
  }
}

double EscapeCone::transmitting_sr(double cosine) const {
  const double at = std::clamp(cosine, 0.0, 1.0) * kSteps;
  const auto k = static_cast<std::size_t>(std::min(kSteps - 1, static_cast<int>(at)));
  return sr_[k] + (at - static_cast<double>(k)) * (sr_[k + 1] - sr_[k]);
}

}  // namespace scattermeter
