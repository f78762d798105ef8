#include "core/transport/escape_cone.h"

#include <cmath>
#include <numbers>

#include "core/material/fresnel.h"
#include "core/material/rough_boundary.h"

namespace scattermeter {
namespace {

constexpr int kRings = 32;
constexpr int kSectors = 64;

// ∫ cos T(cos) over the cone, by the cosine of its axis.
template <class Transmittance>
CosineTable cone_table(double cos_half, const Transmittance& transmittance) {
  return CosineTable([&](double cos_axis) {
    const double sin_axis = std::sqrt(1.0 - cos_axis * cos_axis);
    double sum = 0.0;
    // Equal solid angles, by their middles.
    for (int i = 0; i < kRings; ++i) {
      const double c = 1.0 - (1.0 - cos_half) * (i + 0.5) / kRings;
      const double s = std::sqrt(1.0 - c * c);
      for (int j = 0; j < kSectors; ++j) {
        const double around = 2.0 * std::numbers::pi * (j + 0.5) / kSectors;
        const double cosine = c * cos_axis + s * sin_axis * std::cos(around);
        if (cosine > 0.0) sum += cosine * transmittance(cosine);
      }
    }
    return 2.0 * std::numbers::pi * (1.0 - cos_half) * sum / (kRings * kSectors);
  });
}

// For the l of the axis.
CosineTable rough_table(double eta, double cos_half, const CosineTable& transmittance) {
  const CosineTable flux = cone_table(cos_half, transmittance);
  return CosineTable([&](double c) {
    // Of nothing, nothing is scored.
    const double t = transmittance(c);
    return t > 0.0 ? flux(c) * fresnel_transmittance(eta, c) / t : flux(c);
  });
}

}  // namespace

EscapeCone::EscapeCone(double eta_int_over_ext, double surface_alpha) {
  if (!(surface_alpha > 0.0)) {
    sr_.emplace(
        cone_table(kCosHalf, [&](double c) { return fresnel_transmittance(eta_int_over_ext, c); }));
    return;
  }
  const RoughBoundary boundary(surface_alpha, eta_int_over_ext);
  sr_.emplace(rough_table(eta_int_over_ext, kCosHalf,
                          CosineTable([&](double c) { return boundary.transmittance(c); })));
  by_several_sr_.emplace(rough_table(eta_int_over_ext, kCosWideHalf, CosineTable([&](double c) {
                                       return boundary.transmittance_by_several(c);
                                     })));
}

}  // namespace scattermeter
