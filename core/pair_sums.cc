#include "core/pair_sums.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <Eigen/Geometry>

#include "core/triangle_parts.h"

namespace scattermeter {
namespace {

using Density = std::array<double, 3>;

double area_mm2(const Triangle& t) { return 0.5 * (t[1] - t[0]).cross(t[2] - t[0]).norm(); }

// visit(point, weight) for the rule's points on a triangle with a density that is linear.
template <class Visit>
void for_rule(const Triangle& t, const Density& e, double area, const Visit& visit) {
  const Eigen::Vector3d center = (t[0] + t[1] + t[2]) / 3.0;
  for (const TriangleOrbit& orbit : kCowper) {
    const double b = orbit.b();
    for (std::size_t i = 0; i < 3; ++i) {
      const double density = b * (e[0] + e[1] + e[2]) + (orbit.a - b) * e[i];
      visit(center + (orbit.a - b) * (t[i] - center), density * area * orbit.weight);
    }
  }
}

// Integral of density times f(|p - x|) over a triangle into bins; density is linear.
template <class Bins>
class NearIntegral {
 public:
  NearIntegral(const Eigen::Vector3d& p, double weight, const Bins& bins,
               const PairSumOptions& options, double* sums)
      : p_(p), weight_(weight), bins_(bins), options_(options), sums_(sums) {}

  void add(const Triangle& t, const Density& e, double area, double edge) const {
    const Eigen::Vector3d center = (t[0] + t[1] + t[2]) / 3.0;
    const double distance = (center - p_).norm();
    if (edge <= options_.floor_mm || edge * options_.near_ratio <= distance) {
      for_rule(t, e, area, [&](const Eigen::Vector3d& q, double power) {
        bins_.add(static_cast<float>((q - p_).squaredNorm()), static_cast<float>(weight_ * power),
                  sums_);
      });
      return;
    }
    const Triangle m = {0.5 * (t[1] + t[2]), 0.5 * (t[2] + t[0]), 0.5 * (t[0] + t[1])};
    const Density f = {0.5 * (e[1] + e[2]), 0.5 * (e[2] + e[0]), 0.5 * (e[0] + e[1])};
    add({t[0], m[2], m[1]}, {e[0], f[2], f[1]}, 0.25 * area, 0.5 * edge);
    add({t[1], m[0], m[2]}, {e[1], f[0], f[2]}, 0.25 * area, 0.5 * edge);
    add({t[2], m[1], m[0]}, {e[2], f[1], f[0]}, 0.25 * area, 0.5 * edge);
    add({m[0], m[1], m[2]}, {f[0], f[1], f[2]}, 0.25 * area, 0.5 * edge);
  }

 private:
  const Eigen::Vector3d& p_;
  double weight_;
  const Bins& bins_;
  const PairSumOptions& options_;
  double* sums_;
};

}  // namespace

// Zeroth to second moment of entering power.
struct SourceCloud::Moments {
  double power = 0;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  Eigen::Vector3d min, max;  // bounds of the members

  static Moments of(const LitTriangle& t) {
    const auto& c = t.corners_mm;
    const auto& e = t.irradiance_sr_per_mm2;
    Moments m;
    const double sum = e[0] + e[1] + e[2];
    m.power = sum / 3.0 * area_mm2(c);
    // ∫ λ_i λ_j λ_k over a triangle of unit area is 1/10 (i = j = k), 1/30 (two alike), 1/60; a
    // linear density is Σ e_i λ_i. Centroid: (sum + e_i) / (4 sum) of corner i.
    for (int i = 0; i < 3; ++i) m.mean += (sum + e[i]) / (4.0 * sum) * c[i];
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        const double weight = i == j ? (2.0 * sum + 4.0 * e[i]) / 20.0 : (sum + e[i] + e[j]) / 20.0;
        m.covariance += weight / sum * (c[i] - m.mean) * (c[j] - m.mean).transpose();
      }
    }
    m.min = c[0].cwiseMin(c[1]).cwiseMin(c[2]);
    m.max = c[0].cwiseMax(c[1]).cwiseMax(c[2]);
    return m;
  }

  static Moments joined(const Moments& a, const Moments& b) {
    Moments m;
    m.power = a.power + b.power;
    const double share = b.power / m.power;
    const Eigen::Vector3d step = b.mean - a.mean;
    m.mean = a.mean + share * step;
    m.covariance = (1.0 - share) * a.covariance + share * b.covariance +
                   share * (1.0 - share) * step * step.transpose();
    m.min = a.min.cwiseMin(b.min);
    m.max = a.max.cwiseMax(b.max);
    return m;
  }

  double radius() const { return (max - mean).cwiseMax(mean - min).norm(); }
};

SourceCloud::Moments SourceCloud::build(const std::vector<Moments>& leaves, std::int32_t* begin,
                                        std::int32_t* end) {
  const std::size_t at = nodes_.size();
  nodes_.emplace_back();
  Moments m;
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
    const Moments first = build(leaves, begin, middle);
    right = static_cast<std::int32_t>(nodes_.size());
    m = Moments::joined(first, build(leaves, middle, end));
  }
  const Eigen::Matrix3f c = m.covariance.cast<float>();
  const Eigen::Vector3f p = m.mean.cast<float>();
  nodes_[at] = {p.x(),
                p.y(),
                p.z(),
                static_cast<float>(m.power),
                static_cast<float>(m.radius()),
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

SourceCloud::SourceCloud(const IncidentLight& light, const Eigen::Vector3d& origin_mm)
    : origin_mm_(origin_mm), triangles_(light.lit) {
  if (triangles_.empty()) return;
  std::vector<Moments> leaves;
  leaves.reserve(triangles_.size());
  for (LitTriangle& t : triangles_) {
    // Positions relative to the origin from here on.
    for (Eigen::Vector3d& corner : t.corners_mm) corner -= origin_mm_;
    leaves.push_back(Moments::of(t));
  }
  for (const LitTriangle& t : triangles_) {
    Rule& rule = rules_.emplace_back();
    rule.center = ((t.corners_mm[0] + t.corners_mm[1] + t.corners_mm[2]) / 3.0).cast<float>();
    rule.edge = static_cast<float>(longest_edge_mm(t.corners_mm));
    std::size_t k = 0;
    for_rule(t.corners_mm, t.irradiance_sr_per_mm2, area_mm2(t.corners_mm),
             [&](const Eigen::Vector3d& q, double power) {
               rule.x[k] = static_cast<float>(q.x());
               rule.y[k] = static_cast<float>(q.y());
               rule.z[k] = static_cast<float>(q.z());
               rule.power[k++] = static_cast<float>(power);
             });
  }
  std::vector<std::int32_t> order(triangles_.size());
  std::iota(order.begin(), order.end(), 0);
  nodes_.reserve(2 * triangles_.size());
  build(leaves, order.data(), order.data() + order.size());
}

// One site against the tree.
template <class Bins>
struct SourceCloud::Sum {
  const SourceCloud& cloud;
  const Bins& bins;
  const PairSumOptions& options;
  double* sums;
  float x, y, z, radius, far_ratio, near_ratio;
  float xx, xy, xz, yy, yz, zz;  // the site's covariance
  ExitSite near;                 // relative to the cloud's origin

  void visit(std::int32_t at) {
    const Node& node = cloud.nodes_[static_cast<std::size_t>(at)];
    const float dx = node.x - x;
    const float dy = node.y - y;
    const float dz = node.z - z;
    const float far = far_ratio * (node.radius + radius);
    if (dx * dx + dy * dy + dz * dz >= far * far) {
      add_cluster(node, dx, dy, dz);
    } else if (node.right >= 0) {
      visit(at + 1);
      visit(node.right);
    } else {
      add_near(node.triangle);
    }
  }

  // The difference of two independent points has the sum of their covariances C = L L^T. The four
  // points d + L v, v the corners of a cube of even parity, have mean d and covariance C.
  void add_cluster(const Node& node, float dx, float dy, float dz) {
    const auto root = [](float s) { return s > 0.0F ? std::sqrt(s) : 0.0F; };
    const auto over = [](float a, float b) { return b > 0.0F ? a / b : 0.0F; };
    const float l11 = root(node.xx + xx);
    const float l21 = over(node.xy + xy, l11);
    const float l31 = over(node.xz + xz, l11);
    // What a plane parallel to an axis leaves is rounding: below 1e-6 it is none.
    const float c22 = node.yy + yy;
    const float r22 = c22 - l21 * l21;
    const float l22 = r22 > 1e-6F * c22 ? std::sqrt(r22) : 0.0F;
    const float l32 = over(node.yz + yz - l21 * l31, l22);
    const float c33 = node.zz + zz;
    const float r33 = c33 - l31 * l31 - l32 * l32;
    const float l33 = r33 > 1e-6F * c33 ? std::sqrt(r33) : 0.0F;
    const float quarter = 0.25F * node.power;
    constexpr float kV1[4] = {1, 1, -1, -1};
    constexpr float kV2[4] = {1, -1, 1, -1};
    constexpr float kV3[4] = {1, -1, -1, 1};
    float d2[4];
    for (int i = 0; i < 4; ++i) {
      const float px = dx + l11 * kV1[i];
      const float py = dy + l21 * kV1[i] + l22 * kV2[i];
      const float pz = dz + l31 * kV1[i] + l32 * kV2[i] + l33 * kV3[i];
      d2[i] = px * px + py * py + pz * pz;
    }
    for (float s : d2) bins.add(s, quarter, sums);
  }

  void add_near(std::int32_t triangle) {
    const Rule& rule = cloud.rules_[static_cast<std::size_t>(triangle)];
    for (std::size_t i = 0; i < static_cast<std::size_t>(near.n_points); ++i) {
      const Eigen::Vector3f p = near.points_mm[i].template cast<float>();
      if (rule.edge * near_ratio <= (rule.center - p).norm()) {
        const auto weight = static_cast<float>(near.weights[i]);
        for (std::size_t k = 0; k < rule.x.size(); ++k) {
          const float rx = rule.x[k] - p.x();
          const float ry = rule.y[k] - p.y();
          const float rz = rule.z[k] - p.z();
          bins.add(rx * rx + ry * ry + rz * rz, weight * rule.power[k], sums);
        }
        continue;
      }
      const LitTriangle& t = cloud.triangles_[static_cast<std::size_t>(triangle)];
      NearIntegral<Bins>(near.points_mm[i], near.weights[i], bins, options, sums)
          .add(t.corners_mm, t.irradiance_sr_per_mm2, area_mm2(t.corners_mm), rule.edge);
    }
  }
};

template <class Bins>
void SourceCloud::add_to(const ExitSite& site, const Bins& bins, const PairSumOptions& options,
                         double* sums) const {
  if (nodes_.empty()) return;
  const Eigen::Vector3f c = (site.center_mm - origin_mm_).cast<float>();
  const Eigen::Matrix3f s = site.covariance_mm2.cast<float>();
  Sum<Bins> sum{*this,
                bins,
                options,
                sums,
                c.x(),
                c.y(),
                c.z(),
                static_cast<float>(site.radius_mm()),
                static_cast<float>(options.far_ratio),
                static_cast<float>(options.near_ratio),
                s(0, 0),
                s(0, 1),
                s(0, 2),
                s(1, 1),
                s(1, 2),
                s(2, 2),
                moved(site, -origin_mm_)};
  sum.visit(0);
}

template void SourceCloud::add_to(const ExitSite&, const UniformBins&, const PairSumOptions&,
                                  double*) const;
template void SourceCloud::add_to(const ExitSite&, const OctaveBins&, const PairSumOptions&,
                                  double*) const;

}  // namespace scattermeter
