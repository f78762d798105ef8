#include "core/sums/cluster_tree.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_invoke.h>

namespace scattermeter {
namespace {

// Splits points into clusters.
class ClusterSplit {
 public:
  // Where a cluster's points [first, last) are split; first or last: not at all.
  struct Parting {
    std::int32_t middle, left_plane, right_plane;
  };

  // room: memory for as many points.
  ClusterSplit(WeightedPoint* points, WeightedPoint* room) : points_(points), room_(room) {}

  std::vector<ClusterNode> nodes;
  std::vector<ClusterPlane> planes;

  // Adds the cluster of these points and all of its parts.
  std::int32_t split(std::int32_t first, std::int32_t last, std::int32_t bucket = -1,
                     std::int32_t plane = -1) {
    const auto at = static_cast<std::int32_t>(nodes.size());
    const Parting parting = add(first, last, bucket, plane);
    if (parting.middle == first || parting.middle == last) return at;
    if (bucket < 0 && last - first <= ClusterTree::kBucket) bucket = at;
    const std::int32_t left = split(first, parting.middle, bucket, parting.left_plane);
    const std::int32_t right = split(parting.middle, last, bucket, parting.right_plane);
    nodes[static_cast<std::size_t>(at)].left = left;
    nodes[static_cast<std::size_t>(at)].right = right;
    return at;
  }

  // Adds the cluster alone and sorts its points into the order of its parts.
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
    ClusterNode node{};
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
    // The plane's tolerance is relative to the size at which it was found.
    if (plane >= 0 && node.radius_mm < 1e5 * planes[static_cast<std::size_t>(plane)].tolerance) {
      plane = -1;
    }
    Eigen::Index axis = 0;
    const double side = (high - low).head<3>().maxCoeff(&axis);
    const double cut = low[axis] + 0.5 * side;
    Parting parting{first, plane, plane};
    if (last - first > ClusterTree::kLeaf) {
      std::optional<ClusterPlane> found;
      if (plane < 0 && last - first >= kManyPoints) found = plane_of_many({begin, end}, side);
      if (found) {
        parting.middle +=
            divide(begin, end, [&](const WeightedPoint& p) { return found->holds(p.at()); });
        parting.left_plane = static_cast<std::int32_t>(planes.size());
        planes.push_back(*found);
        if (parting.middle == last) {
          plane = parting.right_plane = parting.left_plane;
          parting.middle = first;
        }
      }
      // Does not split points that coincide or differ by rounding.
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

  // Moves the points for which `holds` is true to the front, each kind in its order; returns their
  // number. Points are moved without a branch, which would be mispredicted half of the time.
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

// A whole tree, or the root alone and both parts.
struct Growth {
  ClusterSplit top;
  std::unique_ptr<Growth> left, right;
};
// The positions of a tree's own nodes and planes in the result, and for a single node of its parts.
struct Slot {
  const Growth* tree;
  std::int32_t node, plane, left, right;
};

Growth grown(WeightedPoint* points, WeightedPoint* room, std::int32_t first, std::int32_t last,
             const std::optional<ClusterPlane>& plane) {
  constexpr std::int32_t kWhole = 4096;
  Growth tree{ClusterSplit(points, room), nullptr, nullptr};
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
    return std::make_unique<Growth>(grown(points, room, from, to, own));
  };
  oneapi::tbb::parallel_invoke(
      [&] { tree.left = part(first, parting.middle, parting.left_plane); },
      [&] { tree.right = part(parting.middle, last, parting.right_plane); });
  return tree;
}

// Assigns positions, a node before its parts.
void assign_slots(const Growth& tree, std::int32_t& nodes, std::int32_t& planes,
                  std::vector<Slot>& slots) {
  const std::size_t at = slots.size();
  slots.push_back({&tree, nodes, planes, -1, -1});
  nodes += static_cast<std::int32_t>(tree.top.nodes.size());
  planes += static_cast<std::int32_t>(tree.top.planes.size());
  if (tree.left == nullptr) return;
  slots[at].left = nodes;
  assign_slots(*tree.left, nodes, planes, slots);
  slots[at].right = nodes;
  assign_slots(*tree.right, nodes, planes, slots);
}

}  // namespace

// The parts of a large cluster are grown in parallel.
ClusterTree::ClusterTree(std::vector<WeightedPoint>& points) {
  std::vector<WeightedPoint> room(points.size());
  const Growth tree =
      grown(points.data(), room.data(), 0, static_cast<std::int32_t>(points.size()), std::nullopt);
  std::vector<Slot> slots;
  std::int32_t node_count = 0, plane_count = 0;
  assign_slots(tree, node_count, plane_count, slots);
  nodes.resize(static_cast<std::size_t>(node_count));
  planes.resize(static_cast<std::size_t>(plane_count));
  oneapi::tbb::parallel_for(std::size_t{0}, slots.size(), [&](std::size_t i) {
    const Slot& p = slots[i];
    std::copy(p.tree->top.planes.begin(), p.tree->top.planes.end(), planes.begin() + p.plane);
    ClusterNode* to = &nodes[static_cast<std::size_t>(p.node)];
    for (ClusterNode node : p.tree->top.nodes) {
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

}  // namespace scattermeter
