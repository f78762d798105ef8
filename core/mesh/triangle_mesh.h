// A triangle mesh in the world frame.
#pragma once

#include <array>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace scattermeter {

struct TriangleMesh {
  std::vector<Eigen::Vector3d> vertices_mm;   // world frame
  std::vector<std::array<int, 3>> triangles;  // vertex indices, counter-clockwise from outside
};

// Area vector of a triangle: its length is the area in mm^2, its direction the outward normal.
Eigen::Vector3d area_vector_mm2(const TriangleMesh& mesh, int triangle_idx);

// Volume enclosed by a closed, oriented mesh (divergence theorem), in mm^3; negative when the
// orientation is inside out.
double signed_volume_mm3(const TriangleMesh& mesh);

struct Box3d {
  Eigen::Vector3d min_mm;
  Eigen::Vector3d max_mm;
  Eigen::Vector3d size_mm() const { return max_mm - min_mm; }
  Eigen::Vector3d center_mm() const { return 0.5 * (min_mm + max_mm); }
  // Whether both ends of a line are, by one coordinate, beyond the same side by more than that.
  bool is_beside(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double margin_mm) const {
    return (from.cwiseMax(to) - min_mm).minCoeff() < -margin_mm ||
           (max_mm - from.cwiseMin(to)).minCoeff() < -margin_mm;
  }
};

// Axis-aligned bounds of all vertices. Precondition: at least one vertex, else
// std::invalid_argument.
Box3d bounds(const TriangleMesh& mesh);

struct MeshCheckOptions {
  double min_size_mm = 0.5;     // longest side of the bounds below this: presumably in metres
  double max_size_mm = 2000.0;  // ... above this: in micrometres, or not the object
};

// The reason why the mesh is unusable as the boundary of a scattering body, or an empty string: no
// triangles, an index out of range, a vertex that is not finite, a triangle of zero area, an edge
// that is not shared by exactly two triangles in opposite directions (open, or not consistently
// oriented), enclosed volume not positive (inside out), a size outside the options. Vertices at the
// same position count as one (OBJ files often repeat them per face).
std::string mesh_problem(const TriangleMesh& mesh, const MeshCheckOptions& options = {});

// The mesh with vertices at exactly the same position merged; triangles keep their order.
TriangleMesh merge_equal_vertices(const TriangleMesh& mesh);

// Every triangle cut into four at the middles of its edges, `levels` times over: the same surface.
TriangleMesh cut_finer(TriangleMesh mesh, int levels);

}  // namespace scattermeter
