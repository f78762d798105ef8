// The surface that the samples of a picture see, and which of them are safe to use.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "core/mesh/patch_mesh.h"
#include "core/mesh/ray_scene.h"
#include "core/view/sample_map.h"

namespace scattermeter {

// First hits of all rays of a grid. Samples are numbered row by row, as the grid's directions.
class SeenSurface {
 public:
  struct Seen {
    std::int32_t patch = -1;  // -1: background
    std::int32_t facet = -1;
    float distance = 0;   // in lengths of the ray's direction
    float cos_theta = 0;  // see cosine_of()
  };

  // Rays and patches must outlive it.
  SeenSurface(const RayGrid& rays, const RayScene& scene, const PatchMesh& patches,
              const SampleMapOptions& options);

  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(rays_.width) +
           static_cast<std::size_t>(x);
  }
  const Seen& seen(std::size_t i) const { return seen_[i]; }
  // Surface point of a sample, world.
  Eigen::Vector3d point(std::size_t i) const {
    return rays_.origin_in_world_mm +
           static_cast<double>(seen_[i].distance) * rays_.directions_in_world[i].cast<double>();
  }
  // Whether the surface continues smoothly as far as the guard and the reach of edges go, in all
  // eight directions. Precondition: the sample sees a patch.
  bool inside(int x, int y) const;
  // Area of surface that one sample represents, mm^2: its solid angle at its distance and slant.
  // Precondition: the sample sees a patch.
  double footprint_mm2(int x, int y) const;

 private:
  // What another sample sees: the same sheet of surface, what is beyond a convex edge of it, or
  // what rises from it or covers it.
  enum class Ahead { kSmooth, kBeyondEdge, kInFront };
  Ahead ahead(std::size_t i, int xn, int yn) const;
  int reach_px(std::size_t i, int xn, int yn) const;
  // At least what reach_px() is of any sample that sees the same facet as its neighbour.
  int longest_reach_px() const;
  // Marks the samples that have a square of one facet about them, `reach` to each side.
  void mark_amid_facets(int reach);

  static constexpr std::array<std::pair<int, int>, 8> kNeighbours = {
      {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {1, -1}, {-1, 1}, {-1, -1}}};

  const RayGrid& rays_;
  const PatchMesh& patches_;
  SampleMapOptions options_;
  std::vector<Seen> seen_;
  std::vector<std::uint8_t> amid_facet_;
};

}  // namespace scattermeter
