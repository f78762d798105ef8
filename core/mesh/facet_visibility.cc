#include "core/mesh/facet_visibility.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

namespace scattermeter {
namespace {

constexpr double kFacetRounding = 1e-9;
constexpr double kWidest = 1.7;  // tangent of 60 degrees

// A picture of the mesh in square cells.
class Picture {
 public:
  Picture(const TriangleMesh& mesh, const Eigen::Vector3d& camera) {
    const Eigen::Vector3d axis = (bounds(mesh).center_mm() - camera).normalized();
    const Eigen::Vector3d right = axis.unitOrthogonal();
    const Eigen::Vector3d up = axis.cross(right);
    Eigen::Vector2d low = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity());
    Eigen::Vector2d high = -low;
    for (const Eigen::Vector3d& p : mesh.vertices_mm) {
      const Eigen::Vector3d v = p - camera;
      const double z = axis.dot(v);
      at_.emplace_back(right.dot(v) / z, up.dot(v) / z, z);
      const Eigen::Vector2d uv = at_.back().head<2>();
      usable_ = usable_ && z > 0.0 && uv.norm() < kWidest;
      low = low.cwiseMin(uv);
      high = high.cwiseMax(uv);
    }
    low_ = low;
    n_ = std::clamp(static_cast<int>(2.0 * std::sqrt(static_cast<double>(mesh.triangles.size()))),
                    64, 2048);
    per_cell_ = n_ / (high - low).maxCoeff();
    usable_ = usable_ && std::isfinite(per_cell_);
    nearest_.assign(static_cast<std::size_t>(n_) * static_cast<std::size_t>(n_),
                    std::numeric_limits<double>::infinity());
  }
  bool usable() const { return usable_; }

  void file(const std::array<int, 3>& t) {
    const double z = std::min({depth(t[0]), depth(t[1]), depth(t[2])});
    for_cells(t, [&](double& nearest) {
      nearest = std::min(nearest, z);
      return true;
    });
  }
  bool nothing_before(const std::array<int, 3>& t) {
    const double z = std::max({depth(t[0]), depth(t[1]), depth(t[2])});
    return for_cells(t, [&](const double& nearest) { return nearest > z; });
  }

 private:
  double depth(int vertex) const { return at_[static_cast<std::size_t>(vertex)].z(); }

  // All cells of the triangle's bounds; stops when `call` returns false.
  template <class Call>
  bool for_cells(const std::array<int, 3>& t, const Call& call) {
    const auto& a = at_[static_cast<std::size_t>(t[0])];
    const auto& b = at_[static_cast<std::size_t>(t[1])];
    const auto& c = at_[static_cast<std::size_t>(t[2])];
    const auto cell = [&](const Eigen::Vector2d& uv, double round) {
      const Eigen::Array2d u = (uv - low_).array() * per_cell_ + round * n_;
      return Eigen::Array2i(u.floor().cast<int>().max(0).min(n_ - 1));
    };
    const Eigen::Array2i from = cell(a.cwiseMin(b).cwiseMin(c).head<2>(), -kFacetRounding);
    const Eigen::Array2i to = cell(a.cwiseMax(b).cwiseMax(c).head<2>(), kFacetRounding);
    for (int j = from[1]; j <= to[1]; ++j) {
      for (int i = from[0]; i <= to[0]; ++i) {
        if (!call(nearest_[static_cast<std::size_t>(j) * static_cast<std::size_t>(n_) +
                           static_cast<std::size_t>(i)])) {
          return false;
        }
      }
    }
    return true;
  }

  std::vector<Eigen::Vector3d> at_;  // of vertices: across, up, along the axis in mm
  bool usable_ = true;
  Eigen::Vector2d low_;
  int n_ = 0;
  double per_cell_ = 0;
  std::vector<double> nearest_;  // mm along the axis
};

}  // namespace

std::vector<bool> surely_seen(const TriangleMesh& mesh, const Eigen::Vector3d& camera_in_world_mm) {
  std::vector<bool> seen(mesh.triangles.size(), false);
  Picture picture(mesh, camera_in_world_mm);
  if (!picture.usable()) return seen;
  for (std::size_t f = 0; f < seen.size(); ++f) {
    const Eigen::Vector3d& a = mesh.vertices_mm[static_cast<std::size_t>(mesh.triangles[f][0])];
    seen[f] =
        area_vector_mm2(mesh, static_cast<int>(f)).normalized().dot(camera_in_world_mm - a) > 0.0;
    if (!seen[f]) picture.file(mesh.triangles[f]);
  }
  for (std::size_t f = 0; f < seen.size(); ++f) {
    if (seen[f]) seen[f] = picture.nothing_before(mesh.triangles[f]);
  }
  return seen;
}

}  // namespace scattermeter
