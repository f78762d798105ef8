// Light from far away, as a light probe shows it.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "core/light/probe_projection.h"

namespace scattermeter {

// Radiance by direction, from so far away that every point of the object sees the same. Radiance is
// constant over the solid angle of each pixel; R, G, B without gamma, in units of the probe's own.
struct Environment {
  int width_px = 0;
  int height_px = 0;
  std::vector<float> radiance;  // height * width * 3: rows from the top, R G B of each pixel
  ProbeProjection projection = ProbeProjection::kEquirectangular;
  Eigen::Quaterniond world_from_probe = Eigen::Quaterniond::Identity();

  // Radiance that a point sees in a world direction (unit length): that of the pixel shown there.
  Eigen::Array3f radiance_toward(const Eigen::Vector3d& direction_in_world) const;
};

// The rotation by which the centre of the picture (of the mirror ball: the camera) shows `forward`
// and its top lies towards `up`. Throws std::invalid_argument for directions that are zero or
// parallel.
Eigen::Quaterniond world_from_probe(const Eigen::Vector3d& forward, const Eigen::Vector3d& up);

// Says what makes a picture unusable as a probe, or an empty string: a size that is not positive or
// does not fit the number of values (3 a pixel), no light at all, or radiance that is negative or
// not finite, named by pixel (x, y from the upper left, from 0) and channel.
std::string probe_problem(int width_px, int height_px, const std::vector<float>& radiance);

}  // namespace scattermeter
