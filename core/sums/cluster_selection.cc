#include "core/sums/cluster_selection.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/sums/cluster_verdicts.h"

namespace scattermeter {
namespace {

constexpr double kLeastLight = 1e-30;
// Most rows of a block receive at least this share of the light at its centre.
constexpr double kDarker = 0.8;

}  // namespace

ClusterSelection::ClusterSelection(const SourceClusters& sources,
                                   std::span<const KernelDipole> dipoles)
    : sources_(sources), media_(dipoles.size()), bounds_(dipoles) {
  for (const KernelDipole& d : dipoles) farthest_pole_mm_ = std::max(farthest_pole_mm_, d.z_v_mm);
}

PerQuantity ClusterSelection::least_light(std::size_t medium) const {
  const ThreeBounds& here = bounds_.largest(medium, 0);
  return {kLeastLight * double(here[0]), kLeastLight * double(here[1]),
          kLeastLight * double(here[2])};
}

std::vector<PerQuantity> ClusterSelection::estimate_light(const RowRegion& region,
                                                          Workspace& workspace) const {
  std::vector<PerQuantity> light(media_, PerQuantity{});
  workspace.nodes.assign(1, 0);
  const auto& nodes = sources_.nodes();
  while (!workspace.nodes.empty()) {
    const ClusterNode& node = nodes[static_cast<std::size_t>(workspace.nodes.back())];
    workspace.nodes.pop_back();
    ++workspace.tests;
    const double d = distance_mm(node, region.center_mm);
    if (node.left >= 0 && node.radius_mm > d + bounds_.nearest_pole_mm()) {
      workspace.nodes.push_back(node.right);
      workspace.nodes.push_back(node.left);
      continue;
    }
    const std::size_t cell = bounds_.cell(d);
    for (std::size_t m = 0; m < media_; ++m) {
      const ThreeBounds& least = bounds_.least(m, cell);
      for (std::size_t q = 0; q < 3; ++q) light[m][q] += kDarker * node.weight * double(least[q]);
    }
  }
  for (std::size_t m = 0; m < media_; ++m) {
    const PerQuantity least = least_light(m);
    for (std::size_t q = 0; q < 3; ++q) light[m][q] = std::max(light[m][q], least[q]);
  }
  return light;
}

void ClusterSelection::build_limit_tables(const std::vector<PerQuantity>& limits,
                                          const RowRegion& region, Workspace& workspace) const {
  constexpr std::size_t kCells = KernelBounds::kCells, kReaches = KernelBounds::kReaches;
  const ClusterNode& root = sources_.nodes()[0];
  const Eigen::Map<const Eigen::Vector3d> middle(root.center_mm);
  const double farthest_mm = (region.center_mm - middle).norm() + region.radius_mm;
  const std::size_t end = std::min(bounds_.cell(farthest_mm + 1.1 * root.radius_mm) + 2, kCells);
  workspace.table_limits = limits;
  workspace.need.assign(KernelBounds::kSeries * kReaches * kCells, 0.0F);
  workspace.all.assign(kCells, 0.0F);
  for (std::size_t m = 0; m < media_; ++m) {
    ThreeBounds per_limit;
    for (std::size_t q = 0; q < 3; ++q) {
      per_limit[q] = static_cast<float>((1.0 + 1e-6) / limits[m][q]);
    }
    const auto raise = [&](const ThreeBounds* bounds, float* to) {
      for (std::size_t k = 0; k < end; ++k) {
        const float most = std::max({bounds[k][0] * per_limit[0], bounds[k][1] * per_limit[1],
                                     bounds[k][2] * per_limit[2]});
        to[k] = std::max(to[k], most);
      }
    };
    raise(&bounds_.largest(m, 0), workspace.all.data());
    for (std::size_t i = 0; i < KernelBounds::kSeries * kReaches; ++i) {
      raise(bounds_.rests(m, i / kReaches) + i % kReaches * kCells, &workspace.need[i * kCells]);
    }
  }
}

// Fills verdicts, rests and nearest_mm for workspace.nodes.
void ClusterSelection::judge(const RowRegion& region, const Criteria& criteria,
                             Workspace& workspace) const {
  VerdictRegion p;
  const ClusterNode& root = sources_.nodes()[0];
  double far = root.radius_mm;
  for (int i = 0; i < 3; ++i) {
    const double at = region.center_mm[i] - root.center_mm[i];
    p.center_mm[i] = static_cast<float>(at);
    far += std::abs(at);
  }
  p.radius_mm = static_cast<float>(1.000001 * region.radius_mm);
  p.slack_mm = static_cast<float>(1e-6 * far);
  p.typical = static_cast<float>(criteria.typical);
  p.share = static_cast<float>(criteria.share);
  p.nearest_pole_mm = static_cast<float>(bounds_.nearest_pole_mm());
  p.farthest_pole_mm = static_cast<float>(farthest_pole_mm_);
  p.per_cell_unit = static_cast<float>(bounds_.cells_per_mm());
  p.need = workspace.need.data();
  p.all = workspace.all.data();
  p.tail = bounds_.tails();
  const std::size_t room = workspace.nodes.size() + kRowLanes;
  if (workspace.verdicts.size() < room) {
    workspace.verdicts.resize(room);
    workspace.rests.resize(room);
    workspace.nearest_mm.resize(room);
  }
  workspace.tests += static_cast<std::int64_t>(workspace.nodes.size());
  judge_clusters(sources_.traits(), workspace.nodes, p,
                 {workspace.verdicts.data(), workspace.rests.data(), workspace.nearest_mm.data()});
}

void ClusterSelection::select(const RowRegion& region, const Criteria& criteria,
                              Workspace& workspace, std::vector<AcceptedSeries>& accepted,
                              std::vector<PerQuantity>& dropped,
                              std::vector<std::int32_t>& open) const {
  const auto& nodes = sources_.nodes();
  open.clear();
  while (!workspace.nodes.empty()) {
    judge(region, criteria, workspace);
    workspace.next.clear();
    for (std::size_t k = 0; k < workspace.nodes.size(); ++k) {
      const std::int32_t at = workspace.nodes[k];
      const ClusterNode& node = nodes[static_cast<std::size_t>(at)];
      const std::int32_t verdict = workspace.verdicts[k];
      if (verdict >= 0) {
        accepted.push_back({at, static_cast<std::size_t>(verdict), double(workspace.rests[k]),
                            double(workspace.nearest_mm[k])});
      } else if (verdict == kVerdictDrop) {
        const std::size_t cell = bounds_.cell(double(workspace.nearest_mm[k]));
        for (std::size_t m = 0; m < media_; ++m) {
          const ThreeBounds& most = bounds_.largest(m, cell);
          for (std::size_t q = 0; q < 3; ++q) dropped[m][q] += node.weight * double(most[q]);
        }
        ++workspace.dropped;
      } else if (node.left >= 0 && node.radius_mm > criteria.smallest_mm) {
        for (const std::int32_t part : {node.left, node.right}) {
          workspace.next.push_back(part);
          __builtin_prefetch(sources_.traits() + part);
          __builtin_prefetch(&nodes[static_cast<std::size_t>(part)]);
          __builtin_prefetch(&nodes[static_cast<std::size_t>(part)].first);
        }
      } else {
        open.push_back(at);
      }
    }
    std::swap(workspace.nodes, workspace.next);
  }
}

}  // namespace scattermeter
