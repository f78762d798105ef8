// Small light probes for tests.
#pragma once

#include <cmath>
#include <numbers>

#include "core/environment.h"
#include "core/fresnel.h"

namespace scattermeter::test_support {

// The same radiance everywhere.
inline Environment even_probe(ProbeProjection projection, int width, int height,
                              const Eigen::Array3f& radiance) {
  Environment probe;
  probe.width_px = width;
  probe.height_px = height;
  probe.projection = projection;
  for (int i = 0; i < width * height; ++i) {
    for (int c = 0; c < 3; ++c) probe.radiance.push_back(radiance[c]);
  }
  return probe;
}

// Integral of cos Ft(eta, cos) over the hemisphere: 2 pi ∫ c Ft(c) dc, by the midpoint rule in
// t = sqrt(c), which takes the steepness near the horizon away.
inline double even_irradiance(double eta) {
  constexpr int kSteps = 20'000;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double t = (i + 0.5) / kSteps;
    sum += t * t * fresnel_transmittance(eta, t * t) * 2.0 * t;
  }
  return 2.0 * std::numbers::pi * sum / kSteps;
}

}  // namespace scattermeter::test_support
