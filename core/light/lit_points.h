// The light on a surface as weighted points.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "core/light/incident_light.h"

namespace scattermeter {

struct LitPoints {
  std::vector<Eigen::Vector3d> points_mm;
  std::vector<double> power_sr;  // entering power per W/sr of intensity; their sum is the light's
};

// A quadrature rule over the lit triangles for kernels that are smooth over `scale_mm` (for the
// dipole: the depth of its source, one mean free path): sum over k of power_k f(x_k) is ∫ E(x) f(x)
// dA. Triangles whose longest edge is at most 0.6 of the scale become three points each (degree 2),
// others six (degree 4), those longer than the scale after a cut into equal parts. For the dipole
// on cubes and pyramids the relative error is then at most 5e-5, a tenth of that in the root mean
// square.
// Empty if this takes more than `most_points` points. Precondition: scale_mm > 0.
std::optional<LitPoints> lit_points(const IncidentLight& light, double scale_mm,
                                    std::size_t most_points);

}  // namespace scattermeter
