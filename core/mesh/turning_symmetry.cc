#include "core/mesh/turning_symmetry.h"

#include <Eigen/Geometry>

#include "core/base/symmetric_eigen.h"

namespace scattermeter {

Eigen::Matrix3d displacing_turns(const TriangleMesh& mesh, const Eigen::Vector3d& center_mm) {
  constexpr double kLeastSlope = 0.04;
  // Integrals over the surface of squares of what is linear on each triangle: of the motion along
  // the normal by a turn w, w . (p x n), and of the distance |p|.
  Eigen::Matrix3d motion = Eigen::Matrix3d::Zero();
  double distance = 0.0;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    const Eigen::Vector3d area_mm2 = area_vector_mm2(mesh, static_cast<int>(f));
    const Eigen::Vector3d normal = area_mm2.normalized();
    Eigen::Matrix3d from_center_mm, by_turn;
    for (int k = 0; k < 3; ++k) {
      const int vertex = mesh.triangles[f][static_cast<std::size_t>(k)];
      from_center_mm.col(k) = mesh.vertices_mm[static_cast<std::size_t>(vertex)] - center_mm;
      by_turn.col(k) = from_center_mm.col(k).cross(normal);
    }
    const Eigen::Vector3d sum = by_turn.rowwise().sum();
    motion += area_mm2.norm() * (by_turn * by_turn.transpose() + sum * sum.transpose());
    distance += area_mm2.norm() *
                (from_center_mm.squaredNorm() + from_center_mm.rowwise().sum().squaredNorm());
  }
  const double least = kLeastSlope * kLeastSlope * distance;
  const SymmetricEigen axes = symmetric_eigen(motion);
  if (axes.values[0] > least) return Eigen::Matrix3d::Identity();
  Eigen::Matrix3d out = Eigen::Matrix3d::Zero();
  for (int k = 0; k < 3; ++k) {
    if (!(axes.values[k] > least)) continue;
    out += axes.vectors.col(k) * axes.vectors.col(k).transpose();
  }
  return out;
}

}  // namespace scattermeter
