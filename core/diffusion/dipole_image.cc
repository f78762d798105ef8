#include "core/diffusion/dipole_image.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <span>
#include <utility>

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/partitioner.h>

#include "core/diffusion/distance_bins.h"
#include "core/diffusion/pair_sums.h"
#include "core/light/lit_points.h"
#include "core/material/dipole.h"
#include "core/sums/dipole_sums.h"

namespace scattermeter {
namespace {

// Some 0.3 kB each. Objects of 250 patches across need 1.5 million.
constexpr std::size_t kMostLitPoints = 2'000'000;
// A certified bound of the sums' relative error: what is measured is about a hundredth of it.
constexpr double kSumTolerance = 1e-3;
constexpr int kSeriesDegree = 6;  // sums fastest for that tolerance

double shortest_mean_free_path_mm(std::span<const Medium> media) {
  double shortest = std::numeric_limits<double>::infinity();
  for (const Medium& m : media) shortest = std::min(shortest, 1.0 / m.sigma_t_prime_per_mm());
  return shortest;
}

// The sum over pairs sorted by distance: near triangles are cut as finely as each point needs, so
// that materials with mean free paths far below the patch size take no more memory.
std::vector<Eigen::Array3d> binned_radiosity(const std::vector<Eigen::Vector3d>& points_mm,
                                             const IncidentLight& light,
                                             const Eigen::Vector3d& origin_mm,
                                             double max_distance_mm,
                                             const std::array<Medium, 3>& media,
                                             const Eigen::Array3d& intensity_W_per_sr) {
  const double mfp_mm = shortest_mean_free_path_mm(media);
  const double resolution_mm = std::min(0.5 * mfp_mm, 0.1 * max_distance_mm);
  const OctaveBins bins(resolution_mm * resolution_mm, max_distance_mm, 9);
  Eigen::Matrix3Xd r(3, bins.size());
  for (int c = 0; c < 3; ++c) {
    const Dipole dipole(media[static_cast<std::size_t>(c)]);
    for (int i = 0; i < bins.size(); ++i) {
      r(c, i) = dipole.reflectance_per_mm2(std::sqrt(bins.knot_s_mm2(i) - bins.s0_mm2()));
    }
  }
  PairSumOptions options;
  options.floor_mm = 0.25 * resolution_mm;
  const SourceCloud sources(light, origin_mm);
  std::vector<Eigen::Array3d> out(points_mm.size());
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, points_mm.size(), kSitesSideBySide),
      [&](const tbb::blocked_range<std::size_t>& range) {
        std::vector<ExitSite> sites;
        for (std::size_t j = range.begin(); j < range.end(); ++j) {
          sites.push_back(exit_point(points_mm[j]));
        }
        std::vector<float> sums(range.size() * static_cast<std::size_t>(bins.sums()));
        add_pair_sums(sources, sites, bins, options, sums.data());
        const float* of_site = sums.data();
        for (std::size_t j = range.begin(); j < range.end(); ++j, of_site += bins.sums()) {
          Eigen::Vector3d sum = Eigen::Vector3d::Zero();
          for (int i = 0; i < bins.size(); ++i) {
            sum += static_cast<double>(OctaveBins::of_knot(of_site, i)) * r.col(i);
          }
          out[j] = intensity_W_per_sr * sum.array();
        }
      },
      tbb::simple_partitioner());
  return out;
}

}  // namespace

SurfaceField::SurfaceField(const PatchMesh& patches, const std::vector<bool>& needed,
                           const std::vector<int>& part_of_facet)
    : node_of_patch_(static_cast<std::size_t>(patches.size()), {-1, -1, -1, -1, -1, -1}) {
  // A corner is the node (v, v), an edge's middle (v, w).
  std::map<std::pair<int, std::pair<int, int>>, int> node_of;
  for (int k = 0; k < patches.size(); ++k) {
    if (!needed[static_cast<std::size_t>(k)]) continue;
    const auto& v = patches.vertex_idx(k);
    const int part =
        part_of_facet.empty() ? 0 : part_of_facet[static_cast<std::size_t>(patches.facet_idx(k))];
    for (int i = 0; i < 6; ++i) {
      const int a = v[i % 3];
      const int b = i < 3 ? a : v[(i + 1) % 3];
      const auto [it, is_new] =
          node_of.try_emplace({part, std::minmax(a, b)}, static_cast<int>(nodes_mm_.size()));
      if (is_new) {
        nodes_mm_.push_back(0.5 * (patches.vertices_mm()[static_cast<std::size_t>(a)] +
                                   patches.vertices_mm()[static_cast<std::size_t>(b)]));
      }
      node_of_patch_[static_cast<std::size_t>(k)][static_cast<std::size_t>(i)] = it->second;
    }
  }
  values_.assign(nodes_mm_.size(), Eigen::Array3d::Zero());
}

void SurfaceField::add(const std::vector<Eigen::Array3d>& values) {
  for (std::size_t i = 0; i < values_.size(); ++i) values_[i] += values[i];
}

Eigen::Array3d SurfaceField::eval(const PatchPoint& at) const {
  const auto& node = node_of_patch_[static_cast<std::size_t>(at.patch_idx)];
  if (node[0] < 0) return Eigen::Array3d::Constant(std::numeric_limits<double>::quiet_NaN());
  const Eigen::Vector3d& w = at.barycentric;
  Eigen::Array3d sum = Eigen::Array3d::Zero();
  // Quadratic shape functions: w_i (2 w_i - 1) at corners, 4 w_i w_j at middles.
  for (int i = 0; i < 3; ++i) {
    sum += w[i] * (2.0 * w[i] - 1.0) * values_[static_cast<std::size_t>(node[i])];
    sum += 4.0 * w[i] * w[(i + 1) % 3] * values_[static_cast<std::size_t>(node[i + 3])];
  }
  // The quadratic may become negative on the dark side of a steep edge.
  return sum.max(0.0);
}

Eigen::Array3d SurfaceField::max() const {
  Eigen::Array3d out = Eigen::Array3d::Zero();
  for (const Eigen::Array3d& v : values_) out = out.max(v);
  return out;
}

std::vector<Eigen::Array3d> dipole_radiosity(const std::vector<Eigen::Vector3d>& points_mm,
                                             const IncidentLight& light,
                                             const Eigen::Vector3d& origin_mm,
                                             double max_distance_mm,
                                             const std::array<Medium, 3>& media,
                                             const Eigen::Array3d& intensity_W_per_sr) {
  std::vector<Medium> lit_media;
  std::vector<Eigen::Index> channels;
  for (Eigen::Index c = 0; c < 3; ++c) {
    if (intensity_W_per_sr[c] == 0.0) continue;
    lit_media.push_back(media[static_cast<std::size_t>(c)]);
    channels.push_back(c);
  }
  const auto lit = lit_points(light, shortest_mean_free_path_mm(lit_media), kMostLitPoints);
  if (!lit) {
    return binned_radiosity(points_mm, light, origin_mm, max_distance_mm, media,
                            intensity_W_per_sr);
  }
  std::vector<std::vector<DipoleSum>> sums(lit_media.size(),
                                           std::vector<DipoleSum>(points_mm.size()));
  sum_dipoles(SourceClusters(lit->points_mm, lit->power_sr, kSeriesDegree), RowBlocks(points_mm),
              lit_media, sums, {.tolerance = kSumTolerance});
  std::vector<Eigen::Array3d> out(points_mm.size(), Eigen::Array3d::Zero());
  for (std::size_t m = 0; m < channels.size(); ++m) {
    const Eigen::Index c = channels[m];
    for (std::size_t j = 0; j < out.size(); ++j) {
      out[j][c] = intensity_W_per_sr[c] * sums[m][j].value;
    }
  }
  return out;
}

double render_patch_size_mm(const std::array<Medium, 3>& media, double object_size_mm) {
  return std::clamp(0.45 * shortest_mean_free_path_mm(media), object_size_mm / 250.0,
                    object_size_mm / 40.0);
}

}  // namespace scattermeter
