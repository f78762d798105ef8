// Surface patches: a mesh cut into small triangles.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "core/mesh/surface_normals.h"
#include "core/mesh/triangle_mesh.h"

namespace scattermeter {

// A point inside a patch.
struct PatchPoint {
  int patch_idx = -1;
  Eigen::Vector3d barycentric;  // weights of the patch's three vertices, sum 1
};

// The facets of a mesh, each bisected at its longest edge until every patch has an area of at most
// size^2 and no edge is longer than 2.5 size. Patches keep their facet's plane and orientation;
// vertices on shared edges are shared.
class PatchMesh {
 public:
  // Preconditions: mesh_problem(mesh) is empty, size_mm > 0. Throws std::invalid_argument for a
  // size that is not positive, and std::length_error when more than max_patches would be needed.
  PatchMesh(const TriangleMesh& mesh, double size_mm, std::size_t max_patches = 4'000'000);

  int size() const { return static_cast<int>(patches_.size()); }
  const std::vector<Eigen::Vector3d>& vertices_mm() const { return vertices_mm_; }
  const std::array<int, 3>& vertex_idx(int patch) const {
    return patches_[static_cast<std::size_t>(patch)];
  }
  std::array<Eigen::Vector3d, 3> corners_mm(int patch) const;
  int facet_idx(int patch) const { return facet_idx_[static_cast<std::size_t>(patch)]; }
  const Eigen::Vector3d& facet_normal(int facet) const { return normals_.of_facet(facet); }
  // Unit normal, at a point of a patch, of the smooth surface that the facets may stand for.
  Eigen::Vector3d normal_at(int patch, const Eigen::Vector3d& point_mm) const {
    return normals_.at(facet_idx(patch), point_mm);
  }
  const SurfaceNormals& surface_normals() const { return normals_; }
  const Eigen::Vector3d& normal(int patch) const { return facet_normal(facet_idx(patch)); }
  Eigen::Vector3d center_mm(int patch) const;
  double area_mm2(int patch) const;
  double patch_size_mm() const { return size_mm_; }

  // The patch that contains a point of a facet. barycentric: weights of the facet's three vertices.
  PatchPoint locate(int facet, const Eigen::Vector3d& barycentric) const;

  // The same for points of which most lie in the patch of the one before.
  class Finder {
   public:
    // The patches must outlive it.
    explicit Finder(const PatchMesh& patches) : patches_(patches) {}
    int patch_idx(int facet, const Eigen::Vector3d& barycentric);

   private:
    const PatchMesh& patches_;
    int facet_ = -1, patch_ = -1;
    Eigen::Matrix3d to_patch_ = Eigen::Matrix3d::Zero();  // from weights of the facet's vertices
  };

 private:
  // A triangle of the bisection tree. A leaf has child < 0 and is patch -child - 1. An inner node
  // was cut from corner `apex` to the middle m of the opposite edge (b, c); its children are
  // consecutive: (apex, b, m) and (apex, m, c).
  struct Node {
    std::int32_t child;
    std::uint8_t apex;
  };
  // Down to a leaf. weights: in the first column those of the facet's vertices, afterwards those of
  // the patch's; the other columns are combined as the first.
  template <int kColumns>
  int descend(int facet, Eigen::Matrix<double, 3, kColumns>& weights) const;

  double size_mm_;
  std::vector<Eigen::Vector3d> vertices_mm_;
  std::vector<std::array<int, 3>> patches_;
  std::vector<int> facet_idx_;
  SurfaceNormals normals_;
  std::vector<Node> nodes_;  // the first ones are the facets
};

}  // namespace scattermeter
