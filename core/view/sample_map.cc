#include "core/view/sample_map.h"

#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <span>
#include <utility>

#include <Eigen/Geometry>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include "core/material/fresnel.h"
#include "core/mesh/triangle_parts.h"
#include "core/view/adjacent_rows.h"

namespace scattermeter {
namespace {

// The part of a hit that the guard and the rows need.
struct Seen {
  std::int32_t patch = -1;
  std::int32_t facet = -1;
  float distance = 0;  // in lengths of the ray's direction
  float cos_theta = 0;
};

template <class Row>
void for_rows(int height, const Row& row) {
  tbb::parallel_for(tbb::blocked_range<int>(0, height, 8),
                    [&](const tbb::blocked_range<int>& range) {
                      for (int y = range.begin(); y < range.end(); ++y) row(y);
                    });
}

class Mapper {
 public:
  Mapper(const RayGrid& rays, const RayScene& scene, const PatchMesh& patches,
         const SampleMapOptions& options)
      : rays_(rays), scene_(scene), patches_(patches), options_(options) {
    seen_.resize(rays.directions_in_world.size());
    for_rows(rays.height, [&](int y) {
      const std::span directions(&rays_.directions_in_world[index(0, y)],
                                 static_cast<std::size_t>(rays_.width));
      std::vector<RayHit> hits(directions.size());
      scene_.first_hits(rays_.origin_in_world_mm, directions, hits);
      for (std::size_t x = 0; x < hits.size(); ++x) {
        const PixelHit hit = pixel_hit(hits[x], patches_, directions[x].cast<double>());
        if (hit.facet_idx < 0) continue;
        seen_[index(static_cast<int>(x), y)] = {hit.at.patch_idx, hit.facet_idx,
                                                static_cast<float>(hits[x].distance),
                                                static_cast<float>(hit.cos_theta)};
      }
    });
  }

  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(rays_.width) +
           static_cast<std::size_t>(x);
  }
  const Seen& seen(std::size_t i) const { return seen_[i]; }

  // Whether the surface continues smoothly as far as the guard reaches, in all eight directions.
  bool inside(int x, int y) const {
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

  // Area of surface that one sample represents, mm^2: its solid angle at its distance and slant.
  double footprint_mm2(int x, int y) const {
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

  // Surface point of a sample, world.
  Eigen::Vector3d point(std::size_t i) const {
    return rays_.origin_in_world_mm +
           static_cast<double>(seen_[i].distance) * rays_.directions_in_world[i].cast<double>();
  }

 private:
  // What another sample sees: the same sheet of surface, what is beyond a convex edge of it, or
  // what rises from it or covers it.
  enum class Ahead { kSmooth, kBeyondEdge, kInFront };

  Ahead ahead(std::size_t i, int xn, int yn) const {
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
  int reach_px(std::size_t i, int xn, int yn) const {
    constexpr double kMost = 64.0;
    if (xn < 0 || yn < 0 || xn >= rays_.width || yn >= rays_.height) return 0;
    const std::size_t neighbour = index(xn, yn);
    if (seen_[neighbour].patch < 0) return 0;
    const double step_mm = (point(neighbour) - point(i)).norm();
    return static_cast<int>(std::ceil(std::min(kMost, options_.edge_reach_mm / step_mm)));
  }

  static constexpr std::array<std::pair<int, int>, 8> kNeighbours = {
      {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {1, -1}, {-1, 1}, {-1, -1}}};

  const RayGrid& rays_;
  const RayScene& scene_;
  const PatchMesh& patches_;
  SampleMapOptions options_;
  std::vector<Seen> seen_;
};

// Samples in the order of their patches: patch k has those from begin_of[k] to begin_of[k + 1].
struct SamplesByPatch {
  std::vector<std::size_t> begin_of;
  std::vector<std::uint32_t> in_order;
};

SamplesByPatch by_patch(const std::vector<std::int32_t>& patch_of_sample, std::size_t n_patches) {
  SamplesByPatch out;
  out.begin_of.assign(n_patches + 1, 0);
  for (const std::int32_t patch : patch_of_sample) {
    if (patch >= 0) ++out.begin_of[static_cast<std::size_t>(patch) + 1];
  }
  std::partial_sum(out.begin_of.begin(), out.begin_of.end(), out.begin_of.begin());
  out.in_order.resize(out.begin_of.back());
  std::vector<std::size_t> next(out.begin_of.begin(), out.begin_of.end() - 1);
  for (std::size_t i = 0; i < patch_of_sample.size(); ++i) {
    if (patch_of_sample[i] < 0) continue;
    out.in_order[next[static_cast<std::size_t>(patch_of_sample[i])]++] =
        static_cast<std::uint32_t>(i);
  }
  return out;
}

// The visible part of each patch, by patch.
struct SeenPatches {
  std::vector<double> area_mm2;
  std::vector<SampleSpread> samples;
  std::vector<std::vector<SampleSpread>> of_quarters;  // if some samples are guarded
};

// Moments of samples, relative to an origin near them: squares of small numbers keep their digits.
class SpreadSum {
 public:
  void add(const Eigen::Vector3d& p) {
    n_ += 1.0;
    sum_ += p;
    square_ += p * p.transpose();
  }
  SampleSpread of(double all, const Eigen::Vector3d& origin_mm) const {
    if (n_ == 0.0) return {};
    const Eigen::Vector3d mean = sum_ / n_;
    return {n_ / all, origin_mm + mean, square_ / n_ - mean * mean.transpose()};
  }

 private:
  double n_ = 0;
  Eigen::Vector3d sum_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d square_ = Eigen::Matrix3d::Zero();
};

SeenPatches seen_patches(const Mapper& mapper, const SamplesByPatch& samples,
                         const std::vector<std::size_t>& guarded, const PatchMesh& patches,
                         std::size_t width) {
  const auto n_patches = static_cast<std::size_t>(patches.size());
  SeenPatches out{std::vector<double>(n_patches, 0.0), std::vector<SampleSpread>(n_patches),
                  std::vector<std::vector<SampleSpread>>(n_patches)};
  tbb::parallel_for(std::size_t{0}, n_patches, [&](std::size_t k) {
    const Eigen::Vector3d center_mm = patches.center_mm(static_cast<int>(k));
    const Triangle corners_mm = patches.corners_mm(static_cast<int>(k));
    SpreadSum all;
    std::array<SpreadSum, 4> quarter;
    for (std::size_t at = samples.begin_of[k]; at < samples.begin_of[k + 1]; ++at) {
      const std::size_t i = samples.in_order[at];
      out.area_mm2[k] +=
          mapper.footprint_mm2(static_cast<int>(i % width), static_cast<int>(i / width));
      const Eigen::Vector3d p = mapper.point(i);
      all.add(p - center_mm);
      if (guarded[k] > 0) quarter[quarter_of(corners_mm, p)].add(p - center_mm);
    }
    const auto count = static_cast<double>(samples.begin_of[k + 1] - samples.begin_of[k]);
    if (!(count > 0.0)) return;
    out.samples[k] = all.of(count, center_mm);
    if (guarded[k] == 0) return;
    for (const SpreadSum& q : quarter) out.of_quarters[k].push_back(q.of(count, center_mm));
  });
  return out;
}

// Adds a row for each patch of which enough is seen; returns the rows of the patches, -1: none.
std::vector<std::int32_t> add_rows(const SeenPatches& seen, const std::vector<std::size_t>& guarded,
                                   const PatchMesh& patches, double min_coverage, SampleMap& map) {
  std::vector<std::int32_t> row_of_patch(seen.area_mm2.size(), -1);
  for (int k = 0; k < patches.size(); ++k) {
    const auto idx = static_cast<std::size_t>(k);
    if (!(seen.area_mm2[idx] > 0.0)) continue;
    const double coverage = seen.area_mm2[idx] / patches.area_mm2(k);
    if (coverage < min_coverage) {
      ++map.patches_partly_seen;
      continue;
    }
    row_of_patch[idx] = static_cast<std::int32_t>(map.patch_of_row.size());
    map.patch_of_row.push_back(k);
    map.coverage.push_back(coverage);
    map.guarded_of_row.push_back(guarded[idx]);
    map.samples.push_back(seen.samples[idx]);
    map.of_quarters.push_back(seen.of_quarters[idx]);
  }
  return row_of_patch;
}

}  // namespace

PixelHit pixel_hit(const RayHit& hit, const PatchMesh& patches, const Eigen::Vector3d& direction) {
  PixelHit out;
  if (hit.facet_idx < 0) return out;
  const double length = direction.norm();
  const double cos_theta = -patches.facet_normal(hit.facet_idx).dot(direction) / length;
  if (!(cos_theta > 0.0)) return out;  // the inner side, through a pinhole of rounding
  out.facet_idx = hit.facet_idx;
  out.at = patches.locate(hit.facet_idx, hit.barycentric);
  out.distance_mm = hit.distance * length;
  out.cos_theta = cos_theta;
  return out;
}

PixelHit trace_pixel(const RayScene& scene, const PatchMesh& patches,
                     const Eigen::Vector3d& origin_mm, const Eigen::Vector3d& direction) {
  if (!direction.allFinite()) return {};
  return pixel_hit(scene.first_hit(origin_mm, direction), patches, direction);
}

SampleMap map_samples(const RayGrid& rays, const RayScene& scene, const PatchMesh& patches,
                      double eta_int_over_ext, const SampleMapOptions& options) {
  SampleMap map;
  map.x0 = rays.x0;
  map.y0 = rays.y0;
  map.width = rays.width;
  map.height = rays.height;
  const std::size_t n = rays.directions_in_world.size();
  const Mapper mapper(rays, scene, patches, options);
  std::vector<std::int32_t> patch_of_sample(n, -1);
  map.pi_over_transmittance.assign(n, 0.0F);
  for_rows(rays.height, [&](int y) {
    for (int x = 0; x < rays.width; ++x) {
      const std::size_t i = mapper.index(x, y);
      if (mapper.seen(i).patch < 0 || !mapper.inside(x, y)) continue;
      const double ft =
          fresnel_transmittance(eta_int_over_ext, static_cast<double>(mapper.seen(i).cos_theta));
      if (!(ft > 0.0)) continue;
      patch_of_sample[i] = mapper.seen(i).patch;
      map.pi_over_transmittance[i] = static_cast<float>(std::numbers::pi / ft);
    }
  });

  const auto n_patches = static_cast<std::size_t>(patches.size());
  std::vector<std::size_t> guarded(n_patches, 0);
  for (std::size_t i = 0; i < n; ++i) {
    if (mapper.seen(i).patch < 0) continue;
    ++map.samples_on_object;
    if (patch_of_sample[i] >= 0) continue;
    ++map.samples_guarded;
    ++guarded[static_cast<std::size_t>(mapper.seen(i).patch)];
  }
  const SeenPatches seen = seen_patches(mapper, by_patch(patch_of_sample, n_patches), guarded,
                                        patches, static_cast<std::size_t>(rays.width));
  const std::vector<std::int32_t> row_of_patch =
      add_rows(seen, guarded, patches, options.min_coverage, map);
  map.row_of_sample.assign(n, -1);
  for (std::size_t i = 0; i < n; ++i) {
    if (patch_of_sample[i] >= 0) {
      map.row_of_sample[i] = row_of_patch[static_cast<std::size_t>(patch_of_sample[i])];
    }
  }
  map.adjacent_rows =
      adjacent_rows(map.row_of_sample, map.width, map.height, map.patch_of_row.size());
  return map;
}

}  // namespace scattermeter
