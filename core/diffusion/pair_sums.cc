#include "core/diffusion/pair_sums.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>
#include <optional>

#include <Eigen/Geometry>

#include "core/mesh/triangle_parts.h"

namespace scattermeter {
PowerMoments SourceCloud::build(const std::vector<PowerMoments>& leaves, std::int32_t* begin,
                                std::int32_t* end) {
  const std::size_t at = nodes_.size();
  nodes_.emplace_back();
  PowerMoments m;
  std::int32_t right = -1;
  if (end - begin == 1) {
    m = leaves[static_cast<std::size_t>(*begin)];
  } else {
    Eigen::Vector3d min = leaves[static_cast<std::size_t>(*begin)].mean;
    Eigen::Vector3d max = min;
    for (const std::int32_t* i = begin; i != end; ++i) {
      min = min.cwiseMin(leaves[static_cast<std::size_t>(*i)].mean);
      max = max.cwiseMax(leaves[static_cast<std::size_t>(*i)].mean);
    }
    Eigen::Index axis = 0;
    (max - min).maxCoeff(&axis);
    std::int32_t* middle = begin + (end - begin) / 2;
    std::nth_element(begin, middle, end, [&](std::int32_t a, std::int32_t b) {
      const double xa = leaves[static_cast<std::size_t>(a)].mean[axis];
      const double xb = leaves[static_cast<std::size_t>(b)].mean[axis];
      return xa != xb ? xa < xb : a < b;
    });
    const PowerMoments first = build(leaves, begin, middle);
    right = static_cast<std::int32_t>(nodes_.size());
    m = PowerMoments::joined(first, build(leaves, middle, end));
  }
  const Eigen::Matrix3f c = m.covariance.cast<float>();
  const Eigen::Vector3f p = m.mean.cast<float>();
  nodes_[at] = {p.x(),
                p.y(),
                p.z(),
                static_cast<float>(m.power),
                static_cast<float>(m.radius_mm()),
                c(0, 0),
                c(0, 1),
                c(0, 2),
                c(1, 1),
                c(1, 2),
                c(2, 2),
                right < 0 ? *begin : -1,
                right};
  return m;
}

SourceCloud::Rule SourceCloud::rule_of(const LitTriangle& t) {
  const Eigen::Vector3d center = middle_mm(t.corners_mm);
  const auto& e = t.irradiance_sr_per_mm2;
  const double mean = (e[0] + e[1] + e[2]) / 3.0, area = area_mm2(t.corners_mm);
  Rule rule;
  const auto fill = [&](const auto& orbits, auto& points) {
    Eigen::Index k = 0;
    for (const TriangleOrbit& orbit : orbits) {
      for (std::size_t i = 0; i < 3; ++i, ++k) {
        const Eigen::Vector3f from_center =
            ((orbit.a - orbit.b()) * (t.corners_mm[i] - center)).template cast<float>();
        const double density = 3.0 * orbit.b() * mean + (orbit.a - orbit.b()) * e[i];
        points.x[k] = from_center.x();
        points.y[k] = from_center.y();
        points.z[k] = from_center.z();
        points.power[k] = static_cast<float>(density * area * orbit.weight);
      }
    }
  };
  rule.center = center.cast<float>();
  rule.edge = static_cast<float>(longest_edge_mm(t.corners_mm));
  fill(kThreePoints, rule.three);
  fill(kCowper, rule.six);
  rule.density = static_cast<float>(mean);
  rule.area = static_cast<float>(area);
  for (std::size_t i = 0; i < 3; ++i) {
    rule.corner[i] = (t.corners_mm[i] - center).cast<float>();
    rule.rise[i] = static_cast<float>(e[i] - mean);
  }
  rule.precise_center = center;
  return rule;
}

SourceCloud::SourceCloud(const IncidentLight& light, const Eigen::Vector3d& origin_mm)
    : origin_mm_(origin_mm) {
  if (light.lit.empty()) return;
  std::vector<LitTriangle> triangles = light.lit;
  std::vector<PowerMoments> leaves;
  leaves.reserve(triangles.size());
  for (LitTriangle& t : triangles) {
    // Positions relative to the origin from here on.
    for (Eigen::Vector3d& corner : t.corners_mm) corner -= origin_mm_;
    leaves.push_back(PowerMoments::of(t));
  }
  std::vector<std::int32_t> order(triangles.size());
  std::iota(order.begin(), order.end(), 0);
  nodes_.reserve(2 * triangles.size());
  build(leaves, order.data(), order.data() + order.size());
  rules_.reserve(triangles.size());
  for (Node& node : nodes_) {
    if (node.right >= 0) continue;
    const auto triangle = static_cast<std::size_t>(node.triangle);
    node.triangle = static_cast<std::int32_t>(rules_.size());
    rules_.push_back(rule_of(triangles[triangle]));
  }
}

// What one site is given of the tree. Pairs of distance and power go to the bins many at a time, so
// that all but the adding itself is done in lanes.
template <class Bins>
class SourceCloud::Sum {
 public:
  Sum(const SourceCloud& cloud, const ExitSite& site, const Bins& bins,
      const PairSumOptions& options, typename Bins::Sum* sums)
      : cloud_(cloud),
        bins_(bins),
        sums_(sums),
        near_(moved(site, -cloud.origin_mm_)),
        at_(near_.center_mm.cast<float>()),
        covariance_(site.covariance_mm2.cast<float>()),
        radius_(static_cast<float>(site.radius_mm())),
        near_ratio2_(static_cast<float>(options.near_ratio * options.near_ratio)),
        floor_mm_(static_cast<float>(options.floor_mm)),
        few_points_ratio_(static_cast<float>(options.few_points_ratio)) {
    // Of six points the last three stand where those of the rule of three do, but farther out.
    constexpr TriangleOrbit kSix = kCowper[1], kThree = kThreePoints[0];
    constexpr double kCloser = (kThree.a - kThree.b()) / (kSix.a - kSix.b());
    const bool six = near_.n_points == 6;
    n_few_ = six ? 3 : near_.n_points;
    for (std::size_t i = 0; i < static_cast<std::size_t>(n_few_); ++i) {
      const Eigen::Vector3d& p = near_.points_mm[six ? i + 3 : i];
      few_points_[i] =
          (near_.center_mm + (six ? kCloser : 1.0) * (p - near_.center_mm)).template cast<float>();
      few_weights_[i] = static_cast<float>(six ? kThree.weight : near_.weights[i]);
    }
  }

  const Eigen::Vector3f& center_mm() const { return at_; }
  float radius_mm() const { return radius_; }

  void keep_cluster(const Node& node, float dx, float dy, float dz) {
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
    const Rule& rule = cloud_.rules_[static_cast<std::size_t>(triangle)];
    const float few = few_points_ratio_ * (rule.edge + radius_);
    if ((rule.center - at_).squaredNorm() >= few * few) {
      for (int i = 0; i < n_few_; ++i) {
        const auto k = static_cast<std::size_t>(i);
        add_points<3>(rule.three, rule.center - few_points_[k], 1.0F,
                      few_weights_[k] * rule.three.power);
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
    constexpr float kLeast = 1e-30F;
    const ClusterLanes c11 = xx_ + covariance_(0, 0);
    const ClusterLanes l11 = (c11 + kLeast).sqrt();
    const ClusterLanes l21 = (xy_ + covariance_(0, 1)) / l11;
    const ClusterLanes l31 = (xz_ + covariance_(0, 2)) / l11;
    // What a plane parallel to an axis leaves is rounding: below 1e-6 it is none. What stands over
    // a root of none is none, too.
    const ClusterLanes c22 = yy_ + covariance_(1, 1);
    const ClusterLanes r22 = (c22 - l21 * l21 - 1e-6F * c22).max(0.0F);
    const ClusterLanes l22 = r22.sqrt();
    const ClusterLanes l32 = (yz_ + covariance_(1, 2) - l21 * l31) * l22 / (r22 + kLeast);
    const ClusterLanes c33 = zz_ + covariance_(2, 2);
    const ClusterLanes l33 = (c33 - l31 * l31 - l32 * l32 - 1e-6F * c33).max(0.0F).sqrt();
    constexpr float kV1[4] = {1, 1, -1, -1};
    constexpr float kV2[4] = {1, -1, 1, -1};
    constexpr float kV3[4] = {1, -1, -1, 1};
    make_room(4 * kClusters);
    for (int i = 0; i < 4; ++i) {
      // Lanes without a cluster write what is then written over.
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
    const Rule& rule;
    Points<8>::Lanes even, slope;  // power of a density of 1, and of one that rises as the rule's
  };
  static Cut cut_of(const Rule& rule, float weight) {
    static const Points<8>::Lanes kShares = [] {
      Points<8>::Lanes shares = Points<8>::Lanes::Zero();
      for (Eigen::Index k = 0; k < 6; ++k) {
        shares[k] = static_cast<float>(kCowper[static_cast<std::size_t>(k / 3)].weight);
      }
      return shares;
    }();
    const Points<8>::Lanes even = (weight * rule.area) * kShares;
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
  // The site as fewer points.
  int n_few_;
  std::array<Eigen::Vector3f, ExitSite::kMaxPoints> few_points_;
  std::array<float, ExitSite::kMaxPoints> few_weights_;
  // What waits for the bins: more room than pairs, since whole lanes are written.
  int pairs_ = 0;
  alignas(16) std::array<float, kPairsAtOnce + kClusters> d2_, power_;
  // Clusters that wait to be replaced by points.
  int clusters_ = 0;
  ClusterLanes x_ = ClusterLanes::Zero(), y_ = x_, z_ = x_, of_cluster_ = x_, xx_ = x_, xy_ = x_,
               xz_ = x_, yy_ = x_, yz_ = x_, zz_ = x_;
};

// Some sites against the tree, in lanes; each comes to its own verdict about every cluster.
template <class Bins>
class SourceCloud::Group {
 public:
  Group(const SourceCloud& cloud, std::span<const ExitSite> sites, const Bins& bins,
        const PairSumOptions& options, typename Bins::Sum* sums)
      : cloud_(cloud), far_ratio_(static_cast<float>(options.far_ratio)) {
    for (std::size_t i = 0; i < sites.size(); ++i) {
      const Sum<Bins>& sum = sums_[i].emplace(cloud, sites[i], bins, options,
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
  // sites: a bit for each that has come here.
  void visit(std::int32_t at, int sites) {
    const Node& node = cloud_.nodes_[static_cast<std::size_t>(at)];
    const float far_of_node = far_ratio_ * node.radius;
    std::array<float, kSideBySide> dx, dy, dz;
    int near = 0;
    for (std::size_t i = 0; i < kSideBySide; ++i) {
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
  std::array<float, kSideBySide> x_{}, y_{}, z_{}, far_of_site_{};
  std::array<std::optional<Sum<Bins>>, kSideBySide> sums_;
};

template <class Bins>
void SourceCloud::add_to(std::span<const ExitSite> sites, const Bins& bins,
                         const PairSumOptions& options, typename Bins::Sum* sums) const {
  if (nodes_.empty()) return;
  for (std::size_t i = 0; i < sites.size(); i += kSideBySide) {
    Group<Bins>(*this, sites.subspan(i, std::min(kSideBySide, sites.size() - i)), bins, options,
                sums + i * static_cast<std::size_t>(bins.size()));
  }
}

template void SourceCloud::add_to(std::span<const ExitSite>, const UniformBins&,
                                  const PairSumOptions&, double*) const;
template void SourceCloud::add_to(std::span<const ExitSite>, const OctaveBins&,
                                  const PairSumOptions&, float*) const;

}  // namespace scattermeter
