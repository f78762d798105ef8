// An analytic clear-sky light probe.
#pragma once

#include <Eigen/Core>

#include "core/light/environment.h"

namespace scattermeter {

// A clear sky with its sun, over a ground. Not a model of the atmosphere, but a light of the same
// contrast. Radiance is relative to the green channel at the zenith.
struct SkyProbe {
  int width_px = 1024;                           // even, at least 16; the height is half of it
  Eigen::Vector3d sun_direction{0.4, 0.6, 0.7};  // any length but 0; z > 0
  double sun_radius_rad = 0.0047;
  double sun_radiance = 1e5;  // of the sun's disc, green
};

// Equirectangular, probe frame = world. Each pixel holds the mean over its solid angle of the sky
// (zenith blue, three times brighter and whiter towards the horizon), of the sun's disc and of the
// ground (a fifth of the horizon, brownish); a pixel within the sun's disc has its radiance, one
// across its edge a share of it. Deterministic. Throws std::invalid_argument outside the domain
// above.
Environment make_sky_probe(const SkyProbe& sky = {});

}  // namespace scattermeter
