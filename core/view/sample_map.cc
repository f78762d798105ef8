#include "core/view/sample_map.h"

#include <algorithm>
#include <array>
#include <numbers>
#include <numeric>

#include <Eigen/Geometry>
#include <oneapi/tbb/parallel_for.h>

#include "core/mesh/triangle_parts.h"
#include "core/view/adjacent_rows.h"
#include "core/view/exit_transmittance.h"
#include "core/view/seen_surface.h"

namespace scattermeter {
namespace {

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

SeenPatches seen_patches(const SeenSurface& surface, const SamplesByPatch& samples,
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
          surface.footprint_mm2(static_cast<int>(i % width), static_cast<int>(i / width));
      const Eigen::Vector3d p = surface.point(i);
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

double cosine_of(const RayHit& hit, const PatchMesh& patches, const Eigen::Vector3d& origin_mm,
                 const Eigen::Vector3d& direction) {
  if (hit.facet_idx < 0 || !(patches.facet_normal(hit.facet_idx).dot(direction) < 0.0)) return 0.0;
  const Eigen::Vector3d normal =
      patches.surface_normals().at(hit.facet_idx, origin_mm + hit.distance * direction);
  return std::max(kLeastCosine, -normal.dot(direction) / direction.norm());
}

PixelHit trace_pixel(const RayScene& scene, const PatchMesh& patches,
                     const Eigen::Vector3d& origin_mm, const Eigen::Vector3d& direction) {
  if (!direction.allFinite()) return {};
  const RayHit hit = scene.first_hit(origin_mm, direction);
  const double cos_theta = cosine_of(hit, patches, origin_mm, direction);
  if (!(cos_theta > 0.0)) return {};
  return {hit.facet_idx, patches.locate(hit.facet_idx, hit.barycentric),
          hit.distance * direction.norm(), cos_theta};
}

SampleMap map_samples(const RayGrid& rays, const RayScene& scene, const PatchMesh& patches,
                      double eta_int_over_ext, const SampleMapOptions& options) {
  SampleMap map;
  map.x0 = rays.x0;
  map.y0 = rays.y0;
  map.width = rays.width;
  map.height = rays.height;
  const std::size_t n = rays.directions_in_world.size();
  const SeenSurface surface(rays, scene, patches, options);
  const ExitTransmittance transmittance(rays, scene, patches, surface, eta_int_over_ext);
  std::vector<std::int32_t> patch_of_sample(n, -1);
  map.pi_over_transmittance.assign(n, 0.0F);
  tbb::parallel_for(0, rays.height, [&](int y) {
    for (int x = 0; x < rays.width; ++x) {
      const std::size_t i = surface.index(x, y);
      if (surface.seen(i).patch < 0 || surface.seen(i).cos_theta < options.least_cosine ||
          !surface.inside(x, y)) {
        continue;
      }
      const double ft = transmittance.of(x, y);
      if (!(ft > 0.0)) continue;
      patch_of_sample[i] = surface.seen(i).patch;
      map.pi_over_transmittance[i] = static_cast<float>(std::numbers::pi / ft);
    }
  });

  const auto n_patches = static_cast<std::size_t>(patches.size());
  std::vector<std::size_t> guarded(n_patches, 0);
  for (std::size_t i = 0; i < n; ++i) {
    if (surface.seen(i).patch < 0) continue;
    ++map.samples_on_object;
    if (patch_of_sample[i] >= 0) continue;
    ++map.samples_guarded;
    ++guarded[static_cast<std::size_t>(surface.seen(i).patch)];
  }
  const SeenPatches seen = seen_patches(surface, by_patch(patch_of_sample, n_patches), guarded,
                                        patches, static_cast<std::size_t>(rays.width));
  const std::vector<std::int32_t> row_of_patch =
      add_rows(seen, guarded, patches, options.min_coverage, map);
  map.row_of_sample.assign(n, -1);
  for (std::size_t i = 0; i < n; ++i) {
    if (patch_of_sample[i] >= 0) {
      map.row_of_sample[i] = row_of_patch[static_cast<std::size_t>(patch_of_sample[i])];
    }
    if (map.row_of_sample[i] < 0) map.pi_over_transmittance[i] = 0.0F;
  }
  map.adjacent_rows =
      adjacent_rows(map.row_of_sample, map.width, map.height, map.patch_of_row.size());
  return map;
}

}  // namespace scattermeter
