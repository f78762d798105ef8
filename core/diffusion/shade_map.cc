#include "core/diffusion/shade_map.h"

#include <algorithm>
#include <numbers>

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include "core/material/fresnel.h"
#include "core/view/pixel_points.h"

namespace scattermeter {
namespace {

constexpr std::int32_t kBackground = -1;

}  // namespace

ShadeMap::Point ShadeMap::trace(const RayScene& scene, const PatchMesh& patches,
                                const Eigen::Vector3d& origin_mm, const Eigen::Vector3d& direction,
                                double eta, std::int32_t* facet) const {
  const PixelHit hit = trace_pixel(scene, patches, origin_mm, direction);
  *facet = hit.facet_idx;
  if (hit.facet_idx < 0) return {kBackground, 0.0F, 0.0F, 0.0F};
  return {hit.at.patch_idx, static_cast<float>(hit.at.barycentric[1]),
          static_cast<float>(hit.at.barycentric[2]),
          static_cast<float>(fresnel_transmittance(eta, hit.cos_theta) / std::numbers::pi)};
}

ShadeMap::ShadeMap(const RayGrid& rays, const RayScene& scene, const PatchMesh& patches,
                   double eta_int_over_ext)
    : x0_(rays.x0), y0_(rays.y0), width_(rays.width), height_(rays.height) {
  const std::size_t n = rays.directions_in_world.size();
  const auto index = [&](int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(x);
  };
  const auto direction = [&](int x, int y) {
    return rays.directions_in_world[index(x, y)].cast<double>().eval();
  };
  centers_.resize(n);
  std::vector<std::int32_t> facet(n, -1);
  const auto for_rows = [&](const auto& row) {
    tbb::parallel_for(tbb::blocked_range<int>(0, height_, 8),
                      [&](const tbb::blocked_range<int>& range) {
                        for (int y = range.begin(); y < range.end(); ++y) row(y);
                      });
  };
  for_rows([&](int y) {
    for (int x = 0; x < width_; ++x) {
      centers_[index(x, y)] = trace(scene, patches, rays.origin_in_world_mm, direction(x, y),
                                    eta_int_over_ext, &facet[index(x, y)]);
    }
  });
  block_of_pixel_.assign(n, -1);
  std::vector<std::array<int, 2>> mixed;
  for (int y = 0; y < height_; ++y) {
    for (int x = 0; x < width_; ++x) {
      const std::int32_t own = facet[index(x, y)];
      bool same = true;
      for (int yn = std::max(0, y - 1); yn <= std::min(height_ - 1, y + 1); ++yn) {
        for (int xn = std::max(0, x - 1); xn <= std::min(width_ - 1, x + 1); ++xn) {
          same = same && facet[index(xn, yn)] == own;
        }
      }
      if (same) continue;
      block_of_pixel_[index(x, y)] = static_cast<std::int32_t>(mixed.size());
      mixed.push_back({x, y});
    }
  }
  blocks_.resize(mixed.size() * kPoints);
  tbb::parallel_for(std::size_t{0}, mixed.size(), [&](std::size_t b) {
    const auto [x, y] = mixed[b];
    const PixelPoints pixel(rays, x, y);
    for (int i = 0; i < kPoints; ++i) {
      std::int32_t unused = 0;
      blocks_[b * kPoints + static_cast<std::size_t>(i)] =
          trace(scene, patches, rays.origin_in_world_mm, pixel.direction(i, kPoints),
                eta_int_over_ext, &unused);
    }
  });
}

const ShadeMap::Point* ShadeMap::begin(int x, int y, int* count) const {
  const std::size_t i =
      static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  const std::int32_t block = block_of_pixel_[i];
  *count = block < 0 ? 1 : kPoints;
  return block < 0 ? &centers_[i] : &blocks_[static_cast<std::size_t>(block) * kPoints];
}

double ShadeMap::coverage(int x, int y) const {
  int n = 0;
  const Point* p = begin(x, y, &n);
  return static_cast<double>(std::count_if(p, p + n, [](const Point& q) { return q.patch >= 0; })) /
         n;
}

std::vector<bool> ShadeMap::needed_patches(int n_patches) const {
  std::vector<bool> needed(static_cast<std::size_t>(n_patches), false);
  for (const std::vector<Point>* points : {&centers_, &blocks_}) {
    for (const Point& p : *points) {
      if (p.patch >= 0) needed[static_cast<std::size_t>(p.patch)] = true;
    }
  }
  return needed;
}

double ShadeMap::radiance(int x, int y, const SurfaceField& field, int channel) const {
  int n = 0;
  const Point* p = begin(x, y, &n);
  double sum = 0.0;
  for (int i = 0; i < n; ++i) {
    if (p[i].patch < 0) continue;
    const double w1 = static_cast<double>(p[i].w1);
    const double w2 = static_cast<double>(p[i].w2);
    const PatchPoint at{p[i].patch, {1.0 - w1 - w2, w1, w2}};
    sum += static_cast<double>(p[i].transmittance_over_pi) * field.eval(at)[channel];
  }
  return sum / n;
}

}  // namespace scattermeter
