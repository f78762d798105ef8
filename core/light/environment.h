// Distant light as recorded by a light probe.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "core/light/probe_projection.h"

namespace scattermeter {

// Radiance by direction, from so far away that it is the same at every point of the object.
// Radiance is constant over the solid angle of each pixel; R, G, B, linear, in arbitrary units of
// the probe.
struct Environment {
  int width_px = 0;
  int height_px = 0;
  std::vector<float> radiance;  // height * width * 3: rows from the top, R G B of each pixel
  ProbeProjection projection = ProbeProjection::kEquirectangular;
  Eigen::Quaterniond world_from_probe = Eigen::Quaterniond::Identity();

  // Radiance seen in a world direction (unit length): that of the pixel in this direction.
  Eigen::Array3f radiance_toward(const Eigen::Vector3d& direction_in_world) const;
};

// The rotation for which the centre of the picture (for a mirror ball: the camera) is in the
// direction `forward` and its top towards `up`. Throws std::invalid_argument for directions that
// are zero or parallel.
Eigen::Quaterniond world_from_probe(const Eigen::Vector3d& forward, const Eigen::Vector3d& up);

// The reason why a picture is unusable as a probe, or an empty string: a size that is not positive
// or does not fit the number of values (3 a pixel), no light at all, or radiance that is negative
// or not finite, with pixel (x, y from the upper left, from 0) and channel.
std::string probe_problem(int width_px, int height_px, const std::vector<float>& radiance);

}  // namespace scattermeter
