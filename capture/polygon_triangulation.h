// Cuts plane polygons into triangles.
#pragma once

#include <array>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace scattermeter::capture {

// Ear clipping of a simple polygon in space, convex or not, given by its corners in order around
// it. Triangles hold corner positions 0 .. n - 1 and keep the polygon's orientation; there are n -
// 2 of them, so that no edge of the outline is lost even where corners lie on a line. A polygon
// that is not quite plane is judged by its projection along its area vector. One that crosses
// itself, or has no area, still yields n - 2 triangles; what the mesh is worth is for the caller to
// check. Fewer than three corners: none. O(n^2) for the polygons met, O(n^3) at worst.
std::vector<std::array<int, 3>> triangulate_polygon(std::span<const Eigen::Vector3d> corners_mm);

}  // namespace scattermeter::capture
