#include "core/view/seen_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

#include <Eigen/Geometry>
#include <oneapi/tbb/parallel_for.h>

#include "core/view/pixel_points.h"

namespace scattermeter {

namespace {

constexpr int kMostReach_px = 64;

}  // namespace

SeenSurface::SeenSurface(const RayGrid& rays, const RayScene& scene, const PatchMesh& patches,
                         const SampleMapOptions& options)
    : rays_(rays), patches_(patches), options_(options) {
  seen_.resize(rays.directions_in_world.size());
  tbb::parallel_for(0, rays.height, [&](int y) {
    const std::span directions(&rays_.directions_in_world[index(0, y)],
                               static_cast<std::size_t>(rays_.width));
    std::vector<RayHit> hits(directions.size());
    scene.first_hits(rays_.origin_in_world_mm, directions, hits);
    PatchMesh::Finder patch(patches_);
    for (std::size_t x = 0; x < hits.size(); ++x) {
      const RayHit& hit = hits[x];
      const double cos_theta =
          cosine_of(hit, patches_, rays_.origin_in_world_mm, directions[x].cast<double>());
      if (!(cos_theta > 0.0)) continue;
      seen_[index(static_cast<int>(x), y)] = {patch.patch_idx(hit.facet_idx, hit.barycentric),
                                              hit.facet_idx, static_cast<float>(hit.distance),
                                              static_cast<float>(cos_theta)};
    }
  });
  mark_amid_facets(std::max(options.guard_px, longest_reach_px()));
}

int SeenSurface::longest_reach_px() const {
  if (!(options_.edge_reach_mm > 0.0) || rays_.width < 2 || rays_.height < 1) return 0;
  // Neighbouring points are at least as far from each other as one is from the other's ray. Rays in
  // the middle stand for all, with a margin for the lens.
  const std::size_t middle = index((rays_.width - 1) / 2, rays_.height / 2);
  const Eigen::Vector3d a = rays_.directions_in_world[middle].cast<double>();
  const Eigen::Vector3d b = rays_.directions_in_world[middle + 1].cast<double>();
  const double angle = a.cross(b).norm() / (a.norm() * b.norm());
  double nearest_mm = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < seen_.size(); ++i) {
    if (seen_[i].patch < 0) continue;
    nearest_mm = std::min(nearest_mm, static_cast<double>(seen_[i].distance) *
                                          rays_.directions_in_world[i].cast<double>().norm());
  }
  constexpr double kMargin = 2.0;
  const double reach = kMargin * options_.edge_reach_mm / (nearest_mm * angle);
  return reach < kMostReach_px ? static_cast<int>(std::ceil(reach)) : kMostReach_px;
}

void SeenSurface::mark_amid_facets(int reach) {
  // First along the rows, then, of what is left, along the columns.
  std::vector<std::uint8_t> along_row(seen_.size(), 0);
  tbb::parallel_for(0, rays_.height, [&](int y) {
    for (int begin = 0, end = 0; begin < rays_.width; begin = end) {
      const std::int32_t facet = seen_[index(begin, y)].facet;
      while (end < rays_.width && seen_[index(end, y)].facet == facet) ++end;
      if (facet < 0) continue;
      for (int x = begin + reach; x < end - reach; ++x) along_row[index(x, y)] = 1;
    }
  });
  amid_facet_.assign(seen_.size(), 0);
  constexpr int kColumns = 64;  // side by side, as memory holds them
  tbb::parallel_for(0, (rays_.width + kColumns - 1) / kColumns, [&](int block) {
    const int first = block * kColumns;
    const int last = std::min(first + kColumns, rays_.width);
    std::array<int, kColumns> begin{};  // of the run above each sample
    for (int y = 0; y < rays_.height; ++y) {
      for (int x = first; x < last; ++x) {
        const std::size_t i = index(x, y);
        int& from = begin[static_cast<std::size_t>(x - first)];
        const bool goes_on =
            y > 0 && along_row[i] != 0 && seen_[i].facet == seen_[index(x, y - 1)].facet;
        if (!goes_on) from = along_row[i] != 0 ? y : y + 1;
        if (y - from >= 2 * reach) amid_facet_[index(x, y - reach)] = 1;
      }
    }
  });
}

bool SeenSurface::inside(int x, int y) const {
  const std::size_t i = index(x, y);
  if (amid_facet_[i] != 0) return true;
  const int g = options_.guard_px;
  for (const auto& [dx, dy] : kNeighbours) {
    if (g > 0 && ahead(i, x + g * dx, y + g * dy) != Ahead::kSmooth) return false;
    if (!(options_.edge_reach_mm > 0.0)) continue;
    const int reach = reach_px(i, x + dx, y + dy);
    if (reach > g && ahead(i, x + reach * dx, y + reach * dy) == Ahead::kBeyondEdge) return false;
  }
  return true;
}

SeenSurface::Ahead SeenSurface::ahead(std::size_t i, int xn, int yn) const {
  if (xn < 0 || yn < 0 || xn >= rays_.width || yn >= rays_.height) return Ahead::kBeyondEdge;
  const std::size_t other_idx = index(xn, yn);
  const Seen& other = seen_[other_idx];
  if (other.patch < 0) return Ahead::kBeyondEdge;
  if (other.facet == seen_[i].facet) return Ahead::kSmooth;
  const Eigen::Vector3d& n = patches_.facet_normal(seen_[i].facet);
  const Eigen::Vector3d step = point(other_idx) - point(i);
  const double height = n.dot(step);
  // Same sheet of surface: normals within 25 degrees, and the other point near the tangent plane.
  const bool is_smooth =
      n.dot(patches_.facet_normal(other.facet)) >= 0.9 && std::abs(height) <= 0.5 * step.norm();
  if (is_smooth) return Ahead::kSmooth;
  return height < 0.0 ? Ahead::kBeyondEdge : Ahead::kInFront;
}

// The steps of a pixel, towards the neighbour (xn, yn), that lead as far as edge_reach_mm.
int SeenSurface::reach_px(std::size_t i, int xn, int yn) const {
  if (xn < 0 || yn < 0 || xn >= rays_.width || yn >= rays_.height) return 0;
  const std::size_t neighbour = index(xn, yn);
  if (seen_[neighbour].patch < 0) return 0;
  const double step_mm = (point(neighbour) - point(i)).norm();
  return static_cast<int>(
      std::ceil(std::min(static_cast<double>(kMostReach_px), options_.edge_reach_mm / step_mm)));
}

double SeenSurface::footprint_mm2(int x, int y) const {
  const std::size_t i = index(x, y);
  const Eigen::Vector3d direction = rays_.directions_in_world[i].cast<double>();
  const double distance_mm = static_cast<double>(seen_[i].distance) * direction.norm();
  const double cos_of_facet =
      -patches_.facet_normal(seen_[i].facet).dot(direction) / direction.norm();
  return PixelPoints(rays_, x, y).solid_angle_sr() * distance_mm * distance_mm / cos_of_facet;
}

}  // namespace scattermeter
