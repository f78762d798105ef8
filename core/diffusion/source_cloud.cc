#include "core/diffusion/source_cloud.h"

#include <algorithm>
#include <numeric>

#include "core/mesh/triangle_parts.h"

namespace scattermeter {
namespace {

SourceCloud::Rule rule_of(const LitTriangle& t) {
  const Eigen::Vector3d center = middle_mm(t.corners_mm);
  const auto& e = t.irradiance_sr_per_mm2;
  const double mean = (e[0] + e[1] + e[2]) / 3.0, area = area_mm2(t.corners_mm);
  SourceCloud::Rule rule;
  const auto fill = [&](const auto& orbits, auto& points) {
    std::size_t k = 0;
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

}  // namespace

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

}  // namespace scattermeter
