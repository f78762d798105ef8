#include "core/view/seen_surface.h"

#include <algorithm>
#include <cmath>
#include <span>

#include <Eigen/Geometry>
#include <oneapi/tbb/parallel_for.h>

namespace scattermeter {

SeenSurface::SeenSurface(const RayGrid& rays, const RayScene& scene, const PatchMesh& patches,
                         const SampleMapOptions& options)
    : rays_(rays), patches_(patches), options_(options) {
  seen_.resize(rays.directions_in_world.size());
  tbb::parallel_for(0, rays.height, [&](int y) {
    const std::span directions(&rays_.directions_in_world[index(0, y)],
                               static_cast<std::size_t>(rays_.width));
    std::vector<RayHit> hits(directions.size());
    scene.first_hits(rays_.origin_in_world_mm, directions, hits);
    for (std::size_t x = 0; x < hits.size(); ++x) {
      const PixelHit hit = pixel_hit(hits[x], patches_, directions[x].cast<double>());
      if (hit.facet_idx < 0) continue;
      seen_[index(static_cast<int>(x), y)] = {hit.at.patch_idx, hit.facet_idx,
                                              static_cast<float>(hits[x].distance),
                                              static_cast<float>(hit.cos_theta)};
    }
  });
}

bool SeenSurface::inside(int x, int y) const {
  const std::size_t i = index(x, y);
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
  constexpr double kMost = 64.0;
  if (xn < 0 || yn < 0 || xn >= rays_.width || yn >= rays_.height) return 0;
  const std::size_t neighbour = index(xn, yn);
  if (seen_[neighbour].patch < 0) return 0;
  const double step_mm = (point(neighbour) - point(i)).norm();
  return static_cast<int>(std::ceil(std::min(kMost, options_.edge_reach_mm / step_mm)));
}

double SeenSurface::footprint_mm2(int x, int y) const {
  const std::size_t i = index(x, y);
  const auto direction = [&](int xx, int yy) {
    return rays_.directions_in_world[index(xx, yy)].cast<double>().eval();
  };
  const int xn = x + 1 < rays_.width ? x + 1 : x - 1;
  const int yn = y + 1 < rays_.height ? y + 1 : y - 1;
  const Eigen::Vector3d d = direction(x, y);
  const double cross = std::abs((direction(xn, y) - d).cross(direction(x, yn) - d).dot(d));
  const double length = d.norm();
  const double solid_angle = cross / (length * length * length);
  const double distance_mm = static_cast<double>(seen_[i].distance) * length;
  return solid_angle * distance_mm * distance_mm / static_cast<double>(seen_[i].cos_theta);
}

}  // namespace scattermeter
