// The sharp edges of a mesh.
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "core/mesh/triangle_mesh.h"

namespace scattermeter {

struct Crease {
  Eigen::Vector3d from_mm, to_mm;
  std::array<Eigen::Vector3d, 2> normals;  // of the facets that meet there
};

// Edges at which the normals of two facets differ by more than `least_rad`, in the order of the
// facets. Vertices at one place count as one. Domain: 0 <= least_rad <= pi.
std::vector<Crease> creases(const TriangleMesh& mesh, double least_rad);

// Facets that meet at more than this are not parts of one smooth surface.
inline constexpr double kCrease_rad = 0.3;

// Whether facets meet nowhere at more than 37 degrees. The light on such a body falls off towards
// the limb, so that what looks like its outline depends on the lamp.
bool is_round(const TriangleMesh& mesh);

}  // namespace scattermeter
