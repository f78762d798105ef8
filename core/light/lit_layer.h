// Decomposition of a patch into triangles on which the irradiance is linear.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include <Eigen/Core>

#include "core/light/incident_light.h"

namespace scattermeter {

// LitTriangle for three channels at once.
struct LitTriangleRgb {
  std::array<Eigen::Vector3d, 3> corners_mm;
  std::array<Eigen::Array3d, 3> irradiance;
  int patch_idx;
};

using PointIrradiance = std::function<Eigen::Array3d(const Eigen::Vector3d& point_mm)>;

// Appends the patch's triangle, bisected at its longest edges (at most `bisections` times) until
// the irradiance in the middle of the longest edge is within `allowed` of the mean of its ends, and
// that in the centre of the mean of the corners.
// Where the corners differ so little that a smooth field would pass (difference^2 / (8 level),
// `level`: the irradiance of an unoccluded facet), these are not evaluated.
void append_smooth(const LitTriangleRgb& patch, const PointIrradiance& irradiance,
                   const Eigen::Array3d& allowed, const Eigen::Array3d& level, int bisections,
                   std::vector<LitTriangleRgb>& out);

// The same for a light with sharp shadows. The irradiance is evaluated in the middle of the longest
// edge and in the centre of every part; at least two bisections are made, and a part that still
// fails after `bisections` gets the mean over 16 points, constant over the part.
void append_edged(const LitTriangleRgb& patch, const PointIrradiance& irradiance,
                  const Eigen::Array3d& allowed, int bisections, std::vector<LitTriangleRgb>& out);

// The light of one channel: dark triangles left out, powers summed by patch.
IncidentLight channel_light(const std::vector<LitTriangleRgb>& triangles, int channel, int patches);

}  // namespace scattermeter
