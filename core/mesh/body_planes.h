// The few planes on which a body's facets lie.
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include <Eigen/Core>

#include "core/mesh/triangle_mesh.h"

namespace scattermeter {

struct BodyPlane {
  Eigen::Vector3d normal;   // unit, outwards
  double offset_mm = 0;     // normal . x on the plane
  std::vector<int> facets;  // that lie on it
  Box3d box;                // of these
  double depth_mm(const Eigen::Vector3d& x) const { return offset_mm - normal.dot(x); }
};

struct BodyPlanes {
  std::vector<BodyPlane> planes;    // empty: more than were allowed
  std::vector<int> plane_of_facet;  // index; empty with the planes
  bool convex = false;              // the body is what lies behind all planes

  // Below the nearest of the planes; infinite without planes.
  double least_depth_mm(const Eigen::Vector3d& x) const {
    double least_mm = std::numeric_limits<double>::infinity();
    for (const BodyPlane& p : planes) least_mm = std::min(least_mm, p.depth_mm(x));
    return least_mm;
  }
};

// Facets belong to one plane where normals agree to 1e-9 and offsets to 1e-9 of the body's size.
// Precondition: mesh_problem(mesh) is empty.
BodyPlanes body_planes(const TriangleMesh& mesh, int most);

}  // namespace scattermeter
