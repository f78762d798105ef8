#include "core/diffusion/pair_sums.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <optional>

#include <Eigen/Geometry>

#include "core/mesh/triangle_parts.h"
#include "core/sums/pair_kernels.h"

namespace scattermeter {
namespace {

// The contributions of the tree to one site. Clusters and points wait until there are enough of
// them for all but the last addition to be done in lanes.
template <class Bins>
class SiteSum {
 public:
  SiteSum(const SourceCloud& cloud, const ExitSite& site, const Bins& bins,
          const PairSumOptions& options, typename Bins::Sum* sums)
      : cloud_(cloud),
        bins_(bins),
        sums_(sums),
        near_(moved(site, -cloud.origin_mm())),
        at_(near_.center_mm.cast<float>()),
        radius_(static_cast<float>(site.radius_mm())),
        near_ratio2_(static_cast<float>(options.near_ratio * options.near_ratio)),
        floor_mm_(static_cast<float>(options.floor_mm)),
        few_points_ratio_(static_cast<float>(options.few_points_ratio)) {
    const Eigen::Matrix3f c = site.covariance_mm2.cast<float>();
    covariance_ = {c(0, 0), c(0, 1), c(0, 2), c(1, 1), c(1, 2), c(2, 2)};
    for (std::size_t i = 0; i < static_cast<std::size_t>(near_.n_few); ++i) {
      few_points_[i] = near_.few_mm[i].template cast<float>();
    }
  }

  const Eigen::Vector3f& center_mm() const { return at_; }
  float radius_mm() const { return radius_; }

  void keep_cluster(const SourceCloud::Node& node, float dx, float dy, float dz) {
    const int i = n_clusters_++;
    clusters_.x[i] = dx;
    clusters_.y[i] = dy;
    clusters_.z[i] = dz;
    clusters_.power[i] = node.power;
    clusters_.xx[i] = node.xx;
    clusters_.xy[i] = node.xy;
    clusters_.xz[i] = node.xz;
    clusters_.yy[i] = node.yy;
    clusters_.yz[i] = node.yz;
    clusters_.zz[i] = node.zz;
    if (n_clusters_ == ClusterBatch::kSize) add_clusters();
  }

  void add_near(std::int32_t triangle) {
    const SourceCloud::Rule& rule = cloud_.rules()[static_cast<std::size_t>(triangle)];
    const float few = few_points_ratio_ * (rule.edge + radius_);
    if ((rule.center - at_).squaredNorm() >= few * few) {
      const float weight = 1.0F / static_cast<float>(near_.n_few);
      for (std::size_t i = 0; i < static_cast<std::size_t>(near_.n_few); ++i) {
        const Eigen::Vector3f v = rule.center - few_points_[i];
        threes_[n_threes_++] = {&rule.three, v.x(), v.y(), v.z(), 1.0F, weight, 0.0F};
        if (n_threes_ == threes_.size()) add_threes();
      }
      return;
    }
    for (std::size_t i = 0; i < static_cast<std::size_t>(near_.n_points); ++i) {
      const Eigen::Vector3f v = rule.center - near_.points_mm[i].template cast<float>();
      const auto weight = static_cast<float>(near_.weights[i]);
      if (rule.edge * rule.edge * near_ratio2_ <= v.squaredNorm()) {
        keep_six(rule, v, 1.0F, weight, 0.0F);
      } else {
        add_parts(rule, weight, (rule.precise_center - near_.points_mm[i]).template cast<float>(),
                  1.0F, rule.density);
      }
    }
  }

  void finish() {
    std::fill(clusters_.power + n_clusters_, clusters_.power + ClusterBatch::kSize, 0.0F);
    if (n_clusters_ > 0) add_clusters();
    add_threes();
    add_sixes();
  }

 private:
  // The most pairs of a kernel's call, and whole lanes beyond.
  static constexpr int kMostPairs = 96;
  using PairLanes = std::array<float, kMostPairs + 16>;
  static constexpr std::size_t kSets = 16;
  static_assert(kClusterPairs <= kMostPairs && 6 * kSets <= kMostPairs);

  // The n pairs that make(d2, power) writes.
  template <class Make>
  void add_pairs(int n, const Make& make) {
    alignas(64) PairLanes d2, power;
    make(d2.data(), power.data());
    bins_.add(d2.data(), power.data(), n, sums_);
  }

  void add_clusters() {
    add_pairs(kClusterPairs, [&](float* d2, float* power) {
      cluster_pairs(clusters_, covariance_.data(), d2, power);
    });
    n_clusters_ = 0;
  }

  void add_threes() {
    const auto n = static_cast<int>(n_threes_);
    add_pairs(3 * n,
              [&](float* d2, float* power) { three_point_pairs(threes_.data(), n, d2, power); });
    n_threes_ = 0;
  }

  void add_sixes() {
    static const std::array<float, 8> kShares = [] {
      std::array<float, 8> shares{};
      for (std::size_t k = 0; k < 6; ++k) shares[k] = static_cast<float>(kCowper[k / 3].weight);
      return shares;
    }();
    const auto n = static_cast<int>(n_sixes_);
    add_pairs(6 * n, [&](float* d2, float* power) {
      six_point_pairs(sixes_.data(), n, kShares.data(), d2, power);
    });
    n_sixes_ = 0;
  }

  // Six points, `scale` times as far from a centroid at v; even: power that is spread evenly.
  void keep_six(const SourceCloud::Rule& rule, const Eigen::Vector3f& v, float scale,
                float of_power, float even) {
    sixes_[n_sixes_++] = {&rule.six, v.x(), v.y(), v.z(), scale, of_power, even};
    if (n_sixes_ == sixes_.size()) add_sixes();
  }

  // A triangle with a linear density, cut into four until its parts are small for their distance.
  // All parts are the triangle itself, `scale` times as large, turned over where that is negative.
  void add_parts(const SourceCloud::Rule& rule, float weight, const Eigen::Vector3f& v, float scale,
                 float density) {
    const float edge = std::abs(scale) * rule.edge;
    if (edge <= floor_mm_ || edge * edge * near_ratio2_ <= v.squaredNorm()) {
      // The density of the part rises `scale` times as much from its centroid as the triangle's.
      const float of_area = weight * (scale * scale);
      keep_six(rule, v, scale, scale * of_area,
               of_area * rule.area * (density - scale * rule.density));
      return;
    }
    const float half = 0.5F * scale;
    for (std::size_t i = 0; i < 3; ++i) {
      add_parts(rule, weight, v + half * rule.corner[i], half, density + half * rule.rise[i]);
    }
    add_parts(rule, weight, v, -half, density);
  }

  const SourceCloud& cloud_;
  const Bins& bins_;
  typename Bins::Sum* sums_;
  ExitSite near_;  // the site, relative to the cloud's origin
  Eigen::Vector3f at_;
  std::array<float, 6> covariance_;
  float radius_, near_ratio2_, floor_mm_, few_points_ratio_;
  std::array<Eigen::Vector3f, 3> few_points_;  // the site as fewer points
  // What waits to be replaced by pairs.
  int n_clusters_ = 0;
  std::size_t n_threes_ = 0, n_sixes_ = 0;
  ClusterBatch clusters_;
  std::array<PlacedPoints<4>, 2 * kSets> threes_;
  std::array<PlacedPoints<8>, kSets> sixes_;
};

// Some sites against the tree, in lanes; for each it is decided separately whether a cluster is far
// enough.
template <class Bins>
class SiteGroup {
 public:
  SiteGroup(const SourceCloud& cloud, std::span<const ExitSite> sites, const Bins& bins,
            const PairSumOptions& options, typename Bins::Sum* sums)
      : cloud_(cloud), far_ratio_(static_cast<float>(options.far_ratio)) {
    for (std::size_t i = 0; i < sites.size(); ++i) {
      const SiteSum<Bins>& sum = sums_[i].emplace(cloud, sites[i], bins, options,
                                                  sums + i * static_cast<std::size_t>(bins.sums()));
      x_[i] = sum.center_mm().x();
      y_[i] = sum.center_mm().y();
      z_[i] = sum.center_mm().z();
      far_of_site_[i] = far_ratio_ * sum.radius_mm();
    }
    visit(0, (1 << sites.size()) - 1);
    for (std::size_t i = 0; i < sites.size(); ++i) sums_[i]->finish();
  }

 private:
  // sites: a bit for each that has reached this node.
  void visit(std::int32_t at, int sites) {
    const SourceCloud::Node& node = cloud_.nodes()[static_cast<std::size_t>(at)];
    // A table, as baseline instructions do not shift each lane by a number of its own.
    constexpr std::array<std::int32_t, kSitesSideBySide> kBits = {1, 2, 4, 8, 16, 32, 64, 128};
    const float far_of_node = far_ratio_ * node.radius;
    std::array<float, kSitesSideBySide> dx, dy, dz;
    int near = 0;
    for (std::size_t i = 0; i < kSitesSideBySide; ++i) {
      dx[i] = node.x - x_[i];
      dy[i] = node.y - y_[i];
      dz[i] = node.z - z_[i];
      const float far = far_of_node + far_of_site_[i];
      const float beyond = dx[i] * dx[i] + dy[i] * dy[i] + dz[i] * dz[i] - far * far;
      near |= (std::bit_cast<std::int32_t>(beyond) >> 31) & kBits[i];
    }
    near &= sites;
    for (auto far = static_cast<unsigned>(sites & ~near); far != 0; far &= far - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(far));
      sums_[i]->keep_cluster(node, dx[i], dy[i], dz[i]);
    }
    if (near == 0) return;
    if (node.right >= 0) {
      visit(at + 1, near);
      visit(node.right, near);
      return;
    }
    for (auto left = static_cast<unsigned>(near); left != 0; left &= left - 1) {
      sums_[static_cast<std::size_t>(std::countr_zero(left))]->add_near(node.triangle);
    }
  }

  const SourceCloud& cloud_;
  float far_ratio_;
  std::array<float, kSitesSideBySide> x_{}, y_{}, z_{}, far_of_site_{};
  std::array<std::optional<SiteSum<Bins>>, kSitesSideBySide> sums_;
};

}  // namespace

template <class Bins>
void add_pair_sums(const SourceCloud& cloud, std::span<const ExitSite> sites, const Bins& bins,
                   const PairSumOptions& options, typename Bins::Sum* sums) {
  if (cloud.nodes().empty()) return;
  for (std::size_t i = 0; i < sites.size(); i += kSitesSideBySide) {
    SiteGroup<Bins>(cloud, sites.subspan(i, std::min(kSitesSideBySide, sites.size() - i)), bins,
                    options, sums + i * static_cast<std::size_t>(bins.sums()));
  }
}

template void add_pair_sums(const SourceCloud&, std::span<const ExitSite>, const UniformBins&,
                            const PairSumOptions&, double*);
template void add_pair_sums(const SourceCloud&, std::span<const ExitSite>, const OctaveBins&,
                            const PairSumOptions&, float*);

}  // namespace scattermeter
