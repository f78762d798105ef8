#include "core/diffusion/pair_sums.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <optional>

#include <Eigen/Geometry>

#include "core/mesh/triangle_parts.h"

namespace scattermeter {
namespace {

// The contributions of the tree to one site. Pairs of distance and power go to the bins many at a
// time, so that all but the addition itself is done in lanes.
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
        covariance_(site.covariance_mm2.cast<float>()),
        radius_(static_cast<float>(site.radius_mm())),
        near_ratio2_(static_cast<float>(options.near_ratio * options.near_ratio)),
        floor_mm_(static_cast<float>(options.floor_mm)),
        few_points_ratio_(static_cast<float>(options.few_points_ratio)) {
    for (std::size_t i = 0; i < static_cast<std::size_t>(near_.n_few); ++i) {
      few_points_[i] = near_.few_mm[i].template cast<float>();
    }
  }

  const Eigen::Vector3f& center_mm() const { return at_; }
  float radius_mm() const { return radius_; }

  void keep_cluster(const SourceCloud::Node& node, float dx, float dy, float dz) {
    const Eigen::Index i = clusters_++;
    x_[i] = dx;
    y_[i] = dy;
    z_[i] = dz;
    of_cluster_[i] = node.power;
    xx_[i] = node.xx;
    xy_[i] = node.xy;
    xz_[i] = node.xz;
    yy_[i] = node.yy;
    yz_[i] = node.yz;
    zz_[i] = node.zz;
    if (clusters_ == kClusters) add_clusters();
  }

  void add_near(std::int32_t triangle) {
    const SourceCloud::Rule& rule = cloud_.rules()[static_cast<std::size_t>(triangle)];
    const float few = few_points_ratio_ * (rule.edge + radius_);
    if ((rule.center - at_).squaredNorm() >= few * few) {
      const float weight = 1.0F / static_cast<float>(near_.n_few);
      for (std::size_t i = 0; i < static_cast<std::size_t>(near_.n_few); ++i) {
        add_points<3>(rule.three, rule.center - few_points_[i], 1.0F, weight * rule.three.power);
      }
      return;
    }
    for (std::size_t i = 0; i < static_cast<std::size_t>(near_.n_points); ++i) {
      const Eigen::Vector3f v = rule.center - near_.points_mm[i].template cast<float>();
      const auto weight = static_cast<float>(near_.weights[i]);
      if (rule.edge * rule.edge * near_ratio2_ <= v.squaredNorm()) {
        add_points<6>(rule.six, v, 1.0F, weight * rule.six.power);
      } else {
        add_parts(cut_of(rule, weight),
                  (rule.precise_center - near_.points_mm[i]).template cast<float>(), 1.0F,
                  rule.density);
      }
    }
  }

  void finish() {
    if (clusters_ > 0) add_clusters();
    flush();
  }

 private:
  static constexpr int kClusters = 16;
  using ClusterLanes = Eigen::Array<float, kClusters, 1>;

  void flush() {
    bins_.add(d2_.data(), power_.data(), pairs_, sums_);
    pairs_ = 0;
  }
  void make_room(int pairs) {
    if (pairs_ + pairs > kPairsAtOnce) flush();
  }

  // The difference of two independent points has the sum of their covariances C = L L^T. The four
  // points d + L v, v the corners of a cube of even parity, have mean d and covariance C.
  void add_clusters() {
    // In a plane that is nearly perpendicular to an axis only rounding is left along it, and a
    // quotient of rounding errors may be of any size: a pivot below 1e-6 of the whole counts as
    // zero, and so does what is divided by its root.
    const ClusterLanes c11 = xx_ + covariance_(0, 0);
    const ClusterLanes c22 = yy_ + covariance_(1, 1);
    const ClusterLanes c33 = zz_ + covariance_(2, 2);
    const ClusterLanes least = 1e-6F * (c11 + c22 + c33);
    const ClusterLanes none = ClusterLanes::Zero();
    const ClusterLanes l11 = (c11 > least).select(c11.sqrt(), none);
    const ClusterLanes l21 = (c11 > least).select((xy_ + covariance_(0, 1)) / l11, none);
    const ClusterLanes l31 = (c11 > least).select((xz_ + covariance_(0, 2)) / l11, none);
    const ClusterLanes r22 = c22 - l21 * l21;
    const ClusterLanes l22 = (r22 > least).select(r22.sqrt(), none);
    const ClusterLanes l32 =
        (r22 > least).select((yz_ + covariance_(1, 2) - l21 * l31) / l22, none);
    const ClusterLanes r33 = c33 - l31 * l31 - l32 * l32;
    const ClusterLanes l33 = (r33 > least).select(r33.sqrt(), none);
    constexpr float kV1[4] = {1, 1, -1, -1};
    constexpr float kV2[4] = {1, -1, 1, -1};
    constexpr float kV3[4] = {1, -1, -1, 1};
    make_room(4 * kClusters);
    for (int i = 0; i < 4; ++i) {
      // Lanes without a cluster write values that are then overwritten.
      Eigen::Map<ClusterLanes> d2(d2_.data() + pairs_), power(power_.data() + pairs_);
      d2 = (x_ + l11 * kV1[i]).square() + (y_ + l21 * kV1[i] + l22 * kV2[i]).square() +
           (z_ + l31 * kV1[i] + l32 * kV2[i] + l33 * kV3[i]).square();
      power = 0.25F * of_cluster_;
      pairs_ += clusters_;
    }
    clusters_ = 0;
  }

  // n points, `scale` times as far from a centroid at v.
  template <int n, class Points>
  void add_points(const Points& points, const Eigen::Vector3f& v, float scale,
                  const typename Points::Lanes& power) {
    using Lanes = typename Points::Lanes;
    make_room(static_cast<int>(power.size()));
    Eigen::Map<Lanes>(d2_.data() + pairs_) = (v.x() + scale * points.x).square() +
                                             (v.y() + scale * points.y).square() +
                                             (v.z() + scale * points.z).square();
    Eigen::Map<Lanes>(power_.data() + pairs_) = power;
    pairs_ += n;
  }

  // A triangle with a linear density, cut into four until its parts are small for their distance.
  // All parts are the triangle itself, `scale` times as large, turned over where that is negative.
  struct Cut {
    const SourceCloud::Rule& rule;
    SourceCloud::Points<8>::Lanes even,
        slope;  // power of a density of 1, and of one that rises as the rule's
  };
  static Cut cut_of(const SourceCloud::Rule& rule, float weight) {
    static const SourceCloud::Points<8>::Lanes kShares = [] {
      SourceCloud::Points<8>::Lanes shares = SourceCloud::Points<8>::Lanes::Zero();
      for (Eigen::Index k = 0; k < 6; ++k) {
        shares[k] = static_cast<float>(kCowper[static_cast<std::size_t>(k / 3)].weight);
      }
      return shares;
    }();
    const SourceCloud::Points<8>::Lanes even = (weight * rule.area) * kShares;
    return {rule, even, weight * rule.six.power - rule.density * even};
  }
  void add_parts(const Cut& cut, const Eigen::Vector3f& v, float scale, float density) {
    const float edge = std::abs(scale) * cut.rule.edge;
    if (edge <= floor_mm_ || edge * edge * near_ratio2_ <= v.squaredNorm()) {
      add_points<6>(cut.rule.six, v, scale,
                    (scale * scale) * (density * cut.even + scale * cut.slope));
      return;
    }
    const float half = 0.5F * scale;
    for (std::size_t i = 0; i < 3; ++i) {
      add_parts(cut, v + half * cut.rule.corner[i], half, density + half * cut.rule.rise[i]);
    }
    add_parts(cut, v, -half, density);
  }

  const SourceCloud& cloud_;
  const Bins& bins_;
  typename Bins::Sum* sums_;
  ExitSite near_;  // the site, relative to the cloud's origin
  Eigen::Vector3f at_;
  Eigen::Matrix3f covariance_;
  float radius_, near_ratio2_, floor_mm_, few_points_ratio_;
  std::array<Eigen::Vector3f, 3> few_points_;  // the site as fewer points
  // Pairs waiting to be binned: more room than pairs, since whole lanes are written.
  int pairs_ = 0;
  alignas(16) std::array<float, kPairsAtOnce + kClusters> d2_, power_;
  // Clusters that wait to be replaced by points.
  int clusters_ = 0;
  ClusterLanes x_ = ClusterLanes::Zero(), y_ = x_, z_ = x_, of_cluster_ = x_, xx_ = x_, xy_ = x_,
               xz_ = x_, yy_ = x_, yz_ = x_, zz_ = x_;
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
                                                  sums + i * static_cast<std::size_t>(bins.size()));
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
    const float far_of_node = far_ratio_ * node.radius;
    std::array<float, kSitesSideBySide> dx, dy, dz;
    int near = 0;
    for (std::size_t i = 0; i < kSitesSideBySide; ++i) {
      dx[i] = node.x - x_[i];
      dy[i] = node.y - y_[i];
      dz[i] = node.z - z_[i];
      const float far = far_of_node + far_of_site_[i];
      const float beyond = dx[i] * dx[i] + dy[i] * dy[i] + dz[i] * dz[i] - far * far;
      near |= (std::bit_cast<std::int32_t>(beyond) >> 31) & (1 << i);
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
                    options, sums + i * static_cast<std::size_t>(bins.size()));
  }
}

template void add_pair_sums(const SourceCloud&, std::span<const ExitSite>, const UniformBins&,
                            const PairSumOptions&, double*);
template void add_pair_sums(const SourceCloud&, std::span<const ExitSite>, const OctaveBins&,
                            const PairSumOptions&, float*);

}  // namespace scattermeter
