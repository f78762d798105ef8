// Irradiance that varies over a patch, as triangles on which it is linear.
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
// Where the corners differ by so little that a smooth field would pass (difference^2 / (8 level),
// `level`: the irradiance of an open facet), they are not asked for. `values`: at the corners.
void append_smooth(const LitTriangleRgb& patch, const PointIrradiance& irradiance,
                   const Eigen::Array3d& allowed, const Eigen::Array3d& level, int bisections,
                   std::vector<LitTriangleRgb>& out);

// The same for a light that throws sharp shadows. The irradiance is asked for in the middle of the
// longest edge and in the centre of every part; at least two bisections are made, and a part that
// still does not pass after `bisections` gets the mean over 16 places, the same all over it.
void append_edged(const LitTriangleRgb& patch, const PointIrradiance& irradiance,
                  const Eigen::Array3d& allowed, int bisections, std::vector<LitTriangleRgb>& out);

// The light of one channel: what is dark left out, powers summed by patch.
IncidentLight channel_light(const std::vector<LitTriangleRgb>& triangles, int channel, int patches);

}  // namespace scattermeter
