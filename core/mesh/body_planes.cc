#include "core/mesh/body_planes.h"

#include <Eigen/Geometry>

namespace scattermeter {
namespace {

constexpr double kSame = 1e-9;

}  // namespace

BodyPlanes body_planes(const TriangleMesh& mesh, int most) {
  BodyPlanes body;
  const double size_mm = bounds(mesh).size_mm().maxCoeff();
  const int n_facets = static_cast<int>(mesh.triangles.size());
  for (int f = 0; f < n_facets; ++f) {
    const auto& t = mesh.triangles[static_cast<std::size_t>(f)];
    const Eigen::Vector3d normal = area_vector_mm2(mesh, f).normalized();
    const double offset_mm = normal.dot(mesh.vertices_mm[static_cast<std::size_t>(t[0])] +
                                        mesh.vertices_mm[static_cast<std::size_t>(t[1])] +
                                        mesh.vertices_mm[static_cast<std::size_t>(t[2])]) /
                             3.0;
    // Neighbours in the file often share a plane: the latest first.
    int k = static_cast<int>(body.planes.size()) - 1;
    for (; k >= 0; --k) {
      const BodyPlane& p = body.planes[static_cast<std::size_t>(k)];
      if ((p.normal - normal).squaredNorm() < kSame * kSame &&
          std::abs(p.offset_mm - offset_mm) < kSame * size_mm) {
        break;
      }
    }
    if (k < 0) {
      if (static_cast<int>(body.planes.size()) == most) return {};
      k = static_cast<int>(body.planes.size());
      const Eigen::Vector3d& corner = mesh.vertices_mm[static_cast<std::size_t>(t[0])];
      body.planes.push_back({normal, offset_mm, {}, {corner, corner}});
    }
    BodyPlane& plane = body.planes[static_cast<std::size_t>(k)];
    plane.facets.push_back(f);
    for (const int i : t) {
      const Eigen::Vector3d& corner = mesh.vertices_mm[static_cast<std::size_t>(i)];
      plane.box = {plane.box.min_mm.cwiseMin(corner), plane.box.max_mm.cwiseMax(corner)};
    }
    body.plane_of_facet.push_back(k);
  }
  body.convex = true;
  for (const BodyPlane& p : body.planes) {
    for (const Eigen::Vector3d& v : mesh.vertices_mm) {
      body.convex = body.convex && p.depth_mm(v) > -kSame * size_mm;
    }
  }
  return body;
}

}  // namespace scattermeter
