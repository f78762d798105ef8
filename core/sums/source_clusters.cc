#include "core/sums/source_clusters.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include "core/sums/moment_kernels.h"
#include "core/sums/series_coefficients.h"

namespace scattermeter {
namespace {

// From this many points on a series of degree kDegrees[i] costs less than the pairs: measured costs
// over that of a pair, planar or not (tests/bench/dipole_sums_bench.cc).
constexpr std::array<std::int32_t, std::size(kDegrees)> kWorthPlanar = {2, 3, 4, 4, 6};
constexpr std::array<std::int32_t, std::size(kDegrees)> kWorth = {2, 3, 4, 6, 12};

}  // namespace

class ClusterBuilder {
 public:
  ClusterBuilder(SourceClusters& out, const std::vector<WeightedPoint>& points,
                 const std::vector<ClusterPlane>& planes)
      : out_(out), points_(points), planes_(planes) {}

  // Fills what the decision about a cluster needs.
  void set_traits(const SourceClusters::Node& node, ClusterTraits& traits) const {
    const double* const middle = out_.nodes_[0].center_mm;
    for (int i = 0; i < 3; ++i) {
      traits.center_mm[i] = static_cast<float>(node.center_mm[i] - middle[i]);
    }
    constexpr double kUp = 1.0 + 1e-6;
    traits.radius_mm = static_cast<float>(kUp * node.radius_mm);
    traits.weight = static_cast<float>(kUp * node.weight);
    traits.last = -1;
    if (node.series < 0) return;
    const auto& worth = node.planar ? kWorthPlanar : kWorth;
    for (std::size_t i = 0; i < std::size(kDegrees); ++i) {
      traits.spread[i] = static_cast<float>(kUp * node.weight * double(node.spread[i]) /
                                            (i == 0 ? 1.0 : node.radius_mm));
      if (kDegrees[i] <= out_.largest_degree_ && node.last - node.first >= worth[i]) {
        traits.last = static_cast<std::int32_t>(i);
      }
    }
  }

  // Computes a cluster's series, or a leaf's points relative to its bucket.
  void finish(SourceClusters::Node& node) {
    const Eigen::Vector3d center = Eigen::Map<Eigen::Vector3d>(node.center_mm);
    if (node.left < 0) {
      const Eigen::Vector3d bucket = Eigen::Map<const Eigen::Vector3d>(
          out_.nodes_[static_cast<std::size_t>(node.bucket)].center_mm);
      for (std::int32_t i = node.first; i < node.last; ++i) {
        const auto k = static_cast<std::size_t>(i);
        const Eigen::Vector3f d = (points_[k].at() - bucket).cast<float>();
        out_.dx_mm_[k] = d.x();
        out_.dy_mm_[k] = d.y();
        out_.dz_mm_[k] = d.z();
      }
      return;
    }
    if (node.series < 0) return;
    float* const to = out_.series_.get() + node.series;
    const auto first = static_cast<std::size_t>(node.first);
    const auto count = static_cast<std::size_t>(node.last - node.first);
    Eigen::Matrix3d frame = Eigen::Matrix3d::Identity();
    node.planar = node.plane >= 0;
    if (node.planar) {
      frame = planes_[static_cast<std::size_t>(node.plane)].frame;
    } else if (const auto found =
                   plane_of_all(std::span(points_).subspan(first, count), center, node.radius_mm)) {
      node.planar = true;
      frame = *found;
    }
    for (Eigen::Index i = 0; i < 9; ++i) to[i] = static_cast<float>(frame(i / 3, i % 3));
    KernelMoments moments;
    const int degree = out_.largest_degree_;
    sum_moments(&out_.x_mm_[first], &out_.y_mm_[first], &out_.z_mm_[first], &out_.weights_[first],
                count, node.center_mm, node.radius_mm, to, node.planar, degree, moments);
    for (std::size_t i = 0; i < 5; ++i) {
      node.spread[i] = static_cast<float>(1.00001 * double(moments.absolute[i]) / node.weight);
    }
    series_coefficients(moments, node.planar, degree, node.weight, to + 9);
  }

 private:
  SourceClusters& out_;
  const std::vector<WeightedPoint>& points_;
  const std::vector<ClusterPlane>& planes_;
};

SourceClusters::SourceClusters(std::span<const Eigen::Vector3d> points_mm,
                               std::span<const double> weights, int largest_degree)
    : largest_degree_(largest_degree) {
  if (points_mm.size() != weights.size()) {
    std::ostringstream text;
    text << "SourceClusters: " << points_mm.size() << " points, " << weights.size() << " weights";
    throw std::invalid_argument(text.str());
  }
  if (std::find(std::begin(kDegrees), std::end(kDegrees), largest_degree) == std::end(kDegrees)) {
    throw std::invalid_argument("SourceClusters: degree " + std::to_string(largest_degree));
  }
  std::vector<WeightedPoint> points;
  points.reserve(points_mm.size());
  for (std::size_t i = 0; i < points_mm.size(); ++i) {
    if (!points_mm[i].allFinite() || !std::isfinite(weights[i]) || weights[i] < 0.0) {
      std::ostringstream text;
      text << "SourceClusters: point " << i << " at " << points_mm[i].transpose() << " mm, weight "
           << weights[i];
      throw std::invalid_argument(text.str());
    }
    if (weights[i] > 0.0) {
      const Eigen::Vector3d& at = points_mm[i];
      points.push_back({{at.x(), at.y(), at.z(), weights[i]}});
      weight_ += weights[i];
    }
  }
  left_out_ = points_mm.size() - points.size();
  if (points.empty()) return;
  const double scale = 1.0 / weight_;
  for (WeightedPoint& p : points) p.placed[3] *= scale;
  ClusterTree tree(points);
  nodes_ = std::move(tree.nodes);
  ClusterBuilder builder(*this, points, tree.planes);
  const std::size_t n = points.size();
  for (auto* v : {&x_mm_, &y_mm_, &z_mm_}) v->resize(n);
  for (auto* v : {&weights_, &dx_mm_, &dy_mm_, &dz_mm_}) v->resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    x_mm_[i] = points[i].placed[0];
    y_mm_[i] = points[i].placed[1];
    z_mm_[i] = points[i].placed[2];
    weights_[i] = static_cast<float>(points[i].weight());
  }
  const auto stride = [&](bool planar) {
    return static_cast<std::int32_t>(9 + coefficient_index(largest_degree + 1, 0, planar));
  };
  std::int32_t series = 0;
  for (Node& node : nodes_) {
    if (node.left < 0 || node.radius_mm > kLargestShare * nodes_[0].radius_mm) continue;
    node.series = series;
    series += stride(node.plane >= 0);
  }
  series_ = std::make_unique_for_overwrite<float[]>(static_cast<std::size_t>(series));
  traits_.resize(nodes_.size());
  oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::size_t>(0, nodes_.size(), 64),
                            [&](const auto& range) {
                              for (std::size_t i = range.begin(); i != range.end(); ++i) {
                                builder.finish(nodes_[i]);
                                builder.set_traits(nodes_[i], traits_[i]);
                              }
                            });
}

KernelCluster SourceClusters::cluster(const Node& node) const {
  const float* const series = series_.get() + node.series;
  return {{node.center_mm[0], node.center_mm[1], node.center_mm[2]},
          node.radius_mm,
          series,
          series + 9,
          node.planar};
}

KernelPoints SourceClusters::points(std::int32_t bucket, std::int32_t first,
                                    std::int32_t last) const {
  const double* const center = nodes_[static_cast<std::size_t>(bucket)].center_mm;
  const auto at = static_cast<std::size_t>(first);
  return {
      {center[0], center[1], center[2]},     &dx_mm_[at], &dy_mm_[at], &dz_mm_[at], &weights_[at],
      static_cast<std::size_t>(last - first)};
}

void SourceClusters::add_exact_sums(std::int32_t first, std::int32_t last,
                                    std::span<const KernelDipole> media, const RowLanes& rows,
                                    std::span<LaneSums> sums) const {
  for (auto k = static_cast<std::size_t>(first); k < static_cast<std::size_t>(last); ++k) {
    for (std::size_t i = 0; i < kRowLanes; ++i) {
      const double dx = rows.x[i] - x_mm_[k], dy = rows.y[i] - y_mm_[k], dz = rows.z[i] - z_mm_[k];
      const double d2 = dx * dx + dy * dy + dz * dz;
      for (std::size_t m = 0; m < media.size(); ++m) {
        for (const double z : {media[m].z_r_mm, media[m].z_v_mm}) {
          const double s = d2 + z * z, rho = std::sqrt(s), y = media[m].kappa_per_mm * rho;
          const double e = double(weights_[k]) * z * std::exp(-y) / rho;
          sums[m].value[i] += e * (1.0 + y) / s;
          sums[m].z_d_z[i] += e / s * (1.0 + y - z * z / s * (3.0 + 3.0 * y + y * y));
          sums[m].decay[i] += e;
        }
      }
    }
  }
}

}  // namespace scattermeter
