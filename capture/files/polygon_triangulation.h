// Triangulation of plane polygons.
#pragma once

#include <array>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace scattermeter::capture {

// Triangulates a simple polygon in space, convex or not, by ear clipping. `corners_mm` are its n
// corners in order. Each triangle holds three corner indices in 0 .. n - 1 and keeps the
// orientation of the polygon. There are n - 2 triangles, so that every edge of the outline is kept
// even where corners are collinear. A polygon that is not exactly plane is projected along its area
// vector. A polygon that intersects itself or has no area also yields n - 2 triangles; checking the
// resulting mesh is left to the caller. Fewer than three corners yield no triangles. O(n^2) for
// typical polygons, O(n^3) at worst.
std::vector<std::array<int, 3>> triangulate_polygon(std::span<const Eigen::Vector3d> corners_mm);

}  // namespace scattermeter::capture
