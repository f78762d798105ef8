#include "core/source_clusters.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>

#include <Eigen/Geometry>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_invoke.h>

namespace scattermeter {

struct WeightedPoint {
  Eigen::Array4d placed;  // x, y, z in mm; weight
  Eigen::Vector3d at() const { return placed.head<3>().matrix(); }
  double weight() const { return placed[3]; }
};

// The plane of many of the points, if there is one: through three of a few samples that holds at
// least a third of them all.
struct ClusterPlane {
  Eigen::Vector3d at, normal;
  double tolerance;
  Eigen::Matrix3d frame;  // rows: axes, the third the normal

  bool holds(const Eigen::Vector3d& p) const { return std::abs(normal.dot(p - at)) <= tolerance; }
};

namespace {

// A cluster is worth its series of degree kDegrees[i] from so many points on: measured costs over
// that of a pair, planar or not (tests/bench/dipole_sums_bench.cc).
constexpr std::array<std::int32_t, std::size(kDegrees)> kWorthPlanar = {2, 3, 4, 4, 6};
constexpr std::array<std::int32_t, std::size(kDegrees)> kWorth = {2, 3, 4, 6, 12};

// Frame whose third axis is the normal of the plane that holds all the points, if one does to
// 1e-7 of the radius, which is less than floats resolve.
bool plane_of(const WeightedPoint* begin, const WeightedPoint* end, const Eigen::Vector3d& center,
              double radius, Eigen::Matrix3d& frame) {
  // Two points as far apart in direction as a few samples offer.
  const auto count = end - begin;
  Eigen::Vector3d a = Eigen::Vector3d::Zero(), normal = Eigen::Vector3d::Zero();
  constexpr int kSamples = 8;
  for (int i = 0; i < kSamples; ++i) {
    const Eigen::Vector3d d = begin[i * (count - 1) / (kSamples - 1)].at() - center;
    if (d.squaredNorm() > a.squaredNorm()) a = d;
  }
  for (int i = 0; i < kSamples; ++i) {
    const Eigen::Vector3d n = a.cross(begin[i * (count - 1) / (kSamples - 1)].at() - center);
    if (n.squaredNorm() > normal.squaredNorm()) normal = n;
  }
  if (!(normal.norm() > 1e-2 * radius * radius)) return false;
  normal.normalize();
  for (const WeightedPoint* p = begin; p != end; ++p) {
    if (std::abs(normal.dot(p->at() - center)) > 1e-7 * radius) return false;
  }
  frame.row(0) = a.normalized();
  frame.row(1) = normal.cross(a.normalized());
  frame.row(2) = normal;
  return true;
}

bool plane_of_many(const WeightedPoint* begin, const WeightedPoint* end, double size,
                   ClusterPlane& plane) {
  constexpr std::ptrdiff_t kSamples = 16, kMany = 6;
  const std::ptrdiff_t count = end - begin;
  const auto sample = [&](std::ptrdiff_t i) {
    return begin[i * (count - 1) / (kSamples - 1)].at();
  };
  for (std::ptrdiff_t i = 0; i < kSamples; ++i) {
    // Neighbours in the order of an earlier split, and ones farther apart.
    for (const std::ptrdiff_t step : {1, 3, 5}) {
      const Eigen::Vector3d a = sample((i + step) % kSamples) - sample(i);
      const Eigen::Vector3d b = sample((i + 2 * step) % kSamples) - sample(i);
      const Eigen::Vector3d n = a.cross(b);
      const double area = n.norm();
      if (!(area > 1e-2 * a.norm() * b.norm()) || !(area > 1e-4 * size * size)) continue;
      plane = {sample(i), n / area, 1e-11 * size, Eigen::Matrix3d::Zero()};
      std::ptrdiff_t on = 0;
      for (std::ptrdiff_t k = 0; k < kSamples; ++k) on += plane.holds(sample(k)) ? 1 : 0;
      if (on < kMany) continue;
      plane.frame.row(0) = a.normalized();
      plane.frame.row(1) = plane.normal.cross(a.normalized());
      plane.frame.row(2) = plane.normal;
      return true;
    }
  }
  return false;
}

// How coefficients come from raw moments: those of |D|^2m are sums of moments of |D|^2(m-1), two
// degrees above.
template <bool kPlanar>
struct CoefficientPlan {
  struct Step {
    std::uint16_t to, from[3];  // planar: two of them
  };
  static constexpr std::size_t kCount = coefficient_place(kLargestDegree + 1, 0, kPlanar);
  std::array<std::uint16_t, kCount> raw{};  // of m = 0: place among the moments
  std::array<Step, kCount> steps{};         // of m >= 1, by falling degree within each m
  std::array<float, kCount> factor{};       // (-1/2)^m / (m! i! j! l!)
  std::array<std::size_t, kLargestDegree + 1> steps_of{};  // how many for a largest degree
};

template <bool kPlanar>
const CoefficientPlan<kPlanar>& coefficient_plan() {
  static const CoefficientPlan<kPlanar> kPlan = [] {
    constexpr double kInverseFactorial[] = {1.0,       1.0,       1.0 / 2,    1.0 / 6,    1.0 / 24,
                                            1.0 / 120, 1.0 / 720, 1.0 / 5040, 1.0 / 40320};
    // Place of x^(k-l-j) y^j z^l among those of degree k.
    const auto place = [](int k, int l, int j) {
      return static_cast<std::size_t>(l * (k + 1) - l * (l - 1) / 2 + j);
    };
    CoefficientPlan<kPlanar> plan;
    std::size_t steps = 0, moments = 0;
    // A step needs those of one m less, of the same degree n.
    for (int n = 0; n <= kLargestDegree; ++n) {
      double sign = 1.0;
      for (int m = 0; 2 * m <= n; ++m) {
        const int k = n - 2 * m;
        const std::size_t base = coefficient_place(n, m, kPlanar);
        const std::size_t above = m > 0 ? coefficient_place(n, m - 1, kPlanar) : 0;
        for (int l = 0; l <= (kPlanar ? 0 : k); ++l) {
          for (int j = 0; j <= k - l; ++j) {
            const std::size_t to = base + place(k, l, j);
            plan.factor[to] = static_cast<float>(sign * kInverseFactorial[k - l - j] *
                                                 kInverseFactorial[j] * kInverseFactorial[l]);
            if (m == 0) {
              plan.raw[to] = static_cast<std::uint16_t>(moments + place(k, l, j));
            } else {
              const auto source = [&](int ll, int jj) {
                return static_cast<std::uint16_t>(above + place(k + 2, ll, jj));
              };
              plan.steps[steps++] = {
                  static_cast<std::uint16_t>(to),
                  {source(l, j), source(l, j + 2), kPlanar ? std::uint16_t{0} : source(l + 2, j)}};
            }
          }
        }
        sign *= -0.5 / (m + 1);
      }
      moments += monomials_of_degree(n, kPlanar);
      plan.steps_of[static_cast<std::size_t>(n)] = steps;
    }
    return plan;
  }();
  return kPlan;
}

// Coefficients of the series from its raw moments.
template <bool kPlanar>
void coefficients_from(const KernelMoments& moments, int degree, double weight, float* out) {
  const auto& plan = coefficient_plan<kPlanar>();
  const std::size_t count = coefficient_place(degree + 1, 0, kPlanar);
  const auto scale = static_cast<float>(1.0 / weight);
  for (int n = 0; n <= degree; ++n) {
    const std::size_t base = coefficient_place(n, 0, kPlanar);
    for (std::size_t i = base; i < base + monomials_of_degree(n, kPlanar); ++i) {
      out[i] = scale * moments.raw[plan.raw[i]];
    }
  }
  for (std::size_t i = 0; i < plan.steps_of[static_cast<std::size_t>(degree)]; ++i) {
    const auto& step = plan.steps[i];
    out[step.to] = out[step.from[0]] + out[step.from[1]] + (kPlanar ? 0.0F : out[step.from[2]]);
  }
  for (std::size_t i = 0; i < count; ++i) out[i] *= plan.factor[i];
}

}  // namespace

// Splits points into clusters.
class ClusterSplit {
 public:
  using Node = SourceClusters::Node;
  // Where a cluster's points [first, last) part; first or last: nowhere.
  struct Parting {
    std::int32_t middle, left_plane, right_plane;
  };

  // `room` for as many points as there are.
  ClusterSplit(WeightedPoint* points, WeightedPoint* room) : points_(points), room_(room) {}

  std::vector<Node> nodes;
  std::vector<ClusterPlane> planes;

  // The cluster of those points and all of its parts.
  std::int32_t split(std::int32_t first, std::int32_t last, std::int32_t bucket = -1,
                     std::int32_t plane = -1) {
    const auto at = static_cast<std::int32_t>(nodes.size());
    const Parting parting = add(first, last, bucket, plane);
    if (parting.middle == first || parting.middle == last) return at;
    if (bucket < 0 && last - first <= SourceClusters::kBucket) bucket = at;
    const std::int32_t left = split(first, parting.middle, bucket, parting.left_plane);
    const std::int32_t right = split(parting.middle, last, bucket, parting.right_plane);
    nodes[static_cast<std::size_t>(at)].left = left;
    nodes[static_cast<std::size_t>(at)].right = right;
    return at;
  }

  // The cluster alone; its points are put in the order of its parts.
  Parting add(std::int32_t first, std::int32_t last, std::int32_t bucket, std::int32_t plane) {
    const auto at = static_cast<std::int32_t>(nodes.size());
    WeightedPoint* const begin = points_ + first;
    WeightedPoint* const end = points_ + last;
    const Eigen::Array4d origin = begin->placed;
    Eigen::Array4d low = origin, high = origin, mean = Eigen::Array4d::Zero();
    double weight = 0.0;
    for (const WeightedPoint* p = begin; p != end; ++p) {
      low = low.min(p->placed);
      high = high.max(p->placed);
      mean += p->weight() * (p->placed - origin);
      weight += p->weight();
    }
    Node node{};
    const Eigen::Array4d center = origin + mean / weight;
    Eigen::Map<Eigen::Vector3d>(node.center_mm) = center.head<3>().matrix();
    double radius2 = 0.0;
    for (const WeightedPoint* p = begin; p != end; ++p) {
      const Eigen::Array4d d2 = (p->placed - center).square();
      radius2 = std::max(radius2, d2[0] + d2[1] + d2[2]);
    }
    node.radius_mm = std::sqrt(radius2) * (1.0 + 1e-12);
    node.weight = weight;
    node.first = first;
    node.last = last;
    node.left = node.right = node.series = -1;
    // A plane holds points to a share of the size it was found at.
    if (plane >= 0 && node.radius_mm < 1e5 * planes[static_cast<std::size_t>(plane)].tolerance) {
      plane = -1;
    }
    Eigen::Index axis = 0;
    const double side = (high - low).head<3>().maxCoeff(&axis);
    const double cut = low[axis] + 0.5 * side;
    Parting parting{first, plane, plane};
    if (last - first > SourceClusters::kLeaf) {
      ClusterPlane found;
      if (plane < 0 && last - first >= kManyPoints && plane_of_many(begin, end, side, found)) {
        parting.middle +=
            divide(begin, end, [&](const WeightedPoint& p) { return found.holds(p.at()); });
        parting.left_plane = static_cast<std::int32_t>(planes.size());
        planes.push_back(found);
        if (parting.middle == last) {
          plane = parting.right_plane = parting.left_plane;
          parting.middle = first;
        }
      }
      // In vain for points that coincide, or differ by a rounding.
      if (parting.middle == first) {
        parting.middle +=
            divide(begin, end, [&](const WeightedPoint& p) { return p.placed[axis] < cut; });
      }
    }
    node.plane = plane;
    node.bucket = bucket < 0 ? at : bucket;
    nodes.push_back(node);
    return parting;
  }

 private:
  static constexpr std::int32_t kManyPoints = 128;

  // Those for which it holds first, each kind in its order; how many they are. Points are moved
  // without a branch, which half of the time would be foretold wrongly.
  template <class Holds>
  std::int32_t divide(WeightedPoint* begin, WeightedPoint* end, const Holds& holds) const {
    WeightedPoint* const other = room_ + (begin - points_);
    std::ptrdiff_t left = 0, right = 0;
    for (WeightedPoint* p = begin; p != end; ++p) {
      const WeightedPoint point = *p;
      const bool is_left = holds(point);
      begin[left] = point;
      other[right] = point;
      left += is_left ? 1 : 0;
      right += is_left ? 0 : 1;
    }
    std::copy(other, other + right, begin + left);
    return static_cast<std::int32_t>(left);
  }

  WeightedPoint* points_;
  WeightedPoint* room_;
};

class ClusterBuilder {
 public:
  ClusterBuilder(SourceClusters& out, std::vector<WeightedPoint>& points)
      : out_(out), points_(points) {}

  // Both parts of a large cluster at the same time.
  void split() {
    std::vector<WeightedPoint> room(points_.size());
    const Tree tree = grown(room, 0, static_cast<std::int32_t>(points_.size()), std::nullopt);
    std::vector<Place> places;
    std::int32_t nodes = 0, planes = 0;
    place(tree, nodes, planes, places);
    out_.nodes_.resize(static_cast<std::size_t>(nodes));
    planes_.resize(static_cast<std::size_t>(planes));
    oneapi::tbb::parallel_for(std::size_t{0}, places.size(), [&](std::size_t i) {
      const Place& p = places[i];
      std::copy(p.tree->top.planes.begin(), p.tree->top.planes.end(), planes_.begin() + p.plane);
      SourceClusters::Node* to = &out_.nodes_[static_cast<std::size_t>(p.node)];
      for (SourceClusters::Node node : p.tree->top.nodes) {
        node.bucket += p.node;
        if (node.left >= 0) {
          node.left += p.node;
          node.right += p.node;
        } else if (p.left >= 0) {
          node.left = p.left;
          node.right = p.right;
        }
        if (node.plane >= 0) node.plane += p.plane;
        *to++ = node;
      }
    });
  }

  // What is to be told of a cluster where it is judged.
  void tell(const SourceClusters::Node& node, ClusterTraits& traits) const {
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

  // The moments of one cluster.
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
    Eigen::Matrix3d frame = Eigen::Matrix3d::Identity();
    const WeightedPoint* const begin = points_.data() + node.first;
    if (node.plane >= 0) {
      node.planar = true;
      frame = planes_[static_cast<std::size_t>(node.plane)].frame;
    } else {
      node.planar = plane_of(begin, points_.data() + node.last, center, node.radius_mm, frame);
    }
    for (Eigen::Index i = 0; i < 9; ++i) to[i] = static_cast<float>(frame(i / 3, i % 3));
    const auto first = static_cast<std::size_t>(node.first);
    KernelMoments moments;
    const int degree = out_.largest_degree_;
    sum_moments(&out_.x_mm_[first], &out_.y_mm_[first], &out_.z_mm_[first], &out_.weights_[first],
                static_cast<std::size_t>(node.last - node.first), node.center_mm, node.radius_mm,
                to, node.planar, degree, moments);
    for (std::size_t i = 0; i < 5; ++i) {
      node.spread[i] = static_cast<float>(1.00001 * double(moments.absolute[i]) / node.weight);
    }
    if (node.planar) {
      coefficients_from<true>(moments, degree, node.weight, to + 9);
    } else {
      coefficients_from<false>(moments, degree, node.weight, to + 9);
    }
  }

 private:
  // A whole tree; or its first node alone, and both parts.
  struct Tree {
    ClusterSplit top;
    std::unique_ptr<Tree> left, right;
  };
  // Where a tree's own nodes and planes come to stand, and of a single node its parts.
  struct Place {
    const Tree* tree;
    std::int32_t node, plane, left, right;
  };

  Tree grown(std::vector<WeightedPoint>& room, std::int32_t first, std::int32_t last,
             const std::optional<ClusterPlane>& plane) const {
    constexpr std::int32_t kWhole = 4096;
    Tree tree{ClusterSplit(points_.data(), room.data()), nullptr, nullptr};
    if (plane) tree.top.planes = {*plane};
    const std::int32_t in = plane ? 0 : -1;
    if (last - first <= kWhole) {
      tree.top.nodes.reserve(static_cast<std::size_t>(last - first) / 2);
      tree.top.split(first, last, -1, in);
      return tree;
    }
    const ClusterSplit::Parting parting = tree.top.add(first, last, -1, in);
    if (parting.middle == first || parting.middle == last) return tree;
    const auto part = [&](std::int32_t from, std::int32_t to, std::int32_t of) {
      std::optional<ClusterPlane> own;
      if (of >= 0) own = tree.top.planes[static_cast<std::size_t>(of)];
      return std::make_unique<Tree>(grown(room, from, to, own));
    };
    oneapi::tbb::parallel_invoke(
        [&] { tree.left = part(first, parting.middle, parting.left_plane); },
        [&] { tree.right = part(parting.middle, last, parting.right_plane); });
    return tree;
  }

  // A node before its parts.
  static void place(const Tree& tree, std::int32_t& nodes, std::int32_t& planes,
                    std::vector<Place>& places) {
    const std::size_t at = places.size();
    places.push_back({&tree, nodes, planes, -1, -1});
    nodes += static_cast<std::int32_t>(tree.top.nodes.size());
    planes += static_cast<std::int32_t>(tree.top.planes.size());
    if (tree.left == nullptr) return;
    places[at].left = nodes;
    place(*tree.left, nodes, planes, places);
    places[at].right = nodes;
    place(*tree.right, nodes, planes, places);
  }

  SourceClusters& out_;
  std::vector<WeightedPoint>& points_;
  std::vector<ClusterPlane> planes_;
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
  ClusterBuilder builder(*this, points);
  builder.split();
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
    return static_cast<std::int32_t>(9 + coefficient_place(largest_degree + 1, 0, planar));
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
                                builder.tell(nodes_[i], traits_[i]);
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
