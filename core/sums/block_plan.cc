#include "core/sums/block_plan.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace scattermeter {
namespace {

// Reusing a table for limits that differ by at most this factor costs less than it saves.
constexpr double kAlike = 1.05;
// Whether a cluster's series is accurate enough is decided for a row nearer than the centre of its
// block, or of the blocks that share a plan, by this share of their radius.
constexpr double kTypical = 0.9;

}  // namespace

std::vector<PerQuantity> BlockPlanner::limits_for(const std::vector<PerQuantity>& light) const {
  std::vector<PerQuantity> limits = light;
  for (PerQuantity& of_medium : limits) {
    for (double& limit : of_medium) limit *= tolerance_;
  }
  return limits;
}

SharedPlan BlockPlanner::plan_shared(std::span<const RowBlocks::Block> blocks,
                                     std::span<const std::vector<PerQuantity>> light, double share,
                                     Workspace& workspace) const {
  Eigen::Vector3d low = blocks[0].center_mm, high = low;
  std::vector<PerQuantity> least = light[0];
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const Eigen::Vector3d r = Eigen::Vector3d::Constant(blocks[b].radius_mm);
    low = low.cwiseMin(blocks[b].center_mm - r);
    high = high.cwiseMax(blocks[b].center_mm + r);
    for (std::size_t m = 0; m < media_; ++m) {
      for (std::size_t q = 0; q < 3; ++q) least[m][q] = std::min(least[m][q], light[b][m][q]);
    }
  }
  SharedPlan shared;
  shared.region = {0.5 * (low + high), 0.0};
  for (const RowBlocks::Block& b : blocks) {
    shared.region.radius_mm = std::max(
        shared.region.radius_mm, (b.center_mm - shared.region.center_mm).norm() + b.radius_mm);
  }
  shared.limits = limits_for(least);
  shared.dropped.assign(media_, {});
  selection_.build_limit_tables(shared.limits, shared.region, workspace.selection);
  workspace.selection.nodes.assign(1, 0);
  selection_.select(shared.region, {kTypical, share, 0.5 * shared.region.radius_mm},
                    workspace.selection, shared.accepted, shared.dropped, shared.open);
  return shared;
}

void BlockPlanner::clear(BlockPlan& plan) const {
  plan.accepted.clear();
  plan.runs.clear();
  for (LeftOut* left_out : {&plan.shared, &plan.own}) {
    left_out->dropped.assign(media_, {});
    left_out->limits.assign(media_, {});
    left_out->series.fill(0.0);
  }
}

void BlockPlanner::add_run(const ClusterNode& leaf, BlockPlan& plan) const {
  if (!plan.runs.empty() && plan.runs.back().bucket == leaf.bucket &&
      plan.runs.back().last == leaf.first) {
    plan.runs.back().last = leaf.last;
  } else {
    plan.runs.push_back({leaf.bucket, leaf.first, leaf.last});
  }
}

void BlockPlanner::plan_direct(BlockPlan& plan) const {
  clear(plan);
  for (const ClusterNode& node : sources_.nodes()) {
    if (node.left < 0) add_run(node, plan);
  }
}

// Adds bounds of what the series leave out for each row.
void BlockPlanner::add_rests(const RowBlocks::Block& block,
                             std::span<const AcceptedSeries> accepted, LeftOut& left_out,
                             Workspace& workspace) const {
  workspace.lane_rests.clear();
  for (const AcceptedSeries& as : accepted) {
    const double* const c = sources_.nodes()[static_cast<std::size_t>(as.node)].center_mm;
    workspace.lane_rests.push_back(
        {{c[0], c[1], c[2]}, as.nearest_mm, as.rest, kFalls[as.series] / 2});
  }
  add_lane_rests(block.lanes, workspace.lane_rests, selection_.bounds().nearest_pole_mm(),
                 left_out.series.data());
}

// The plan for plan.limits where each cluster may use up `share` of them.
void BlockPlanner::make_plan(const RowBlocks::Block& block, const SharedPlan* shared, double share,
                             BlockPlan& plan, Workspace& workspace) const {
  clear(plan);
  ClusterSelection::Workspace& selection = workspace.selection;
  // Tables are made for the limits that neighbours share, unless a block's own limits are far from
  // a common multiple of these: then for its own.
  double larger = 1.0;
  bool alike = shared != nullptr;
  if (shared != nullptr) {
    plan.shared.dropped = shared->dropped;
    plan.shared.limits = shared->limits;
    add_rests(block, shared->accepted, plan.shared, workspace);
    selection.nodes.assign(shared->open.begin(), shared->open.end());
    double least = std::numeric_limits<double>::infinity(), most = 0.0;
    for (std::size_t m = 0; m < media_; ++m) {
      for (std::size_t q = 0; q < 3; ++q) {
        const double ratio = plan.limits[m][q] / shared->limits[m][q];
        least = std::min(least, ratio);
        most = std::max(most, ratio);
      }
    }
    alike = most <= kAlike * least;
    if (alike) larger = least;
  } else {
    selection.nodes.assign(1, 0);
  }
  const RowRegion region{block.center_mm, block.radius_mm};
  plan.own.limits = alike ? shared->limits : plan.limits;
  if (selection.table_limits != plan.own.limits) {
    selection_.build_limit_tables(plan.own.limits, alike ? shared->region : region, selection);
  }
  selection_.select(region, {kTypical, share * larger, 0.0}, selection, plan.accepted,
                    plan.own.dropped, workspace.open);
  add_rests(block, plan.accepted, plan.own, workspace);
  std::sort(workspace.open.begin(), workspace.open.end());
  for (const std::int32_t at : workspace.open) {
    add_run(sources_.nodes()[static_cast<std::size_t>(at)], plan);
  }
}

// Of any row, over the limits.
double BlockPlanner::largest_error(const BlockPlan& plan) const {
  double largest = 0.0;
  for (std::size_t m = 0; m < media_; ++m) {
    for (std::size_t q = 0; q < 3; ++q) {
      for (std::size_t row = 0; row < kRowLanes; ++row) {
        largest = std::max(largest, plan.error(m, q, row) / plan.limits[m][q]);
      }
    }
  }
  return largest;
}

bool BlockPlanner::fit(const RowBlocks::Block& block, const std::vector<PerQuantity>& light,
                       const SharedPlan* shared, double& share, BlockPlan& plan,
                       Workspace& workspace) const {
  // Of the limits, which come from a light that is only estimated.
  constexpr double kWanted = 0.75, kEnough = 0.15, kMost = 0.9;
  plan.limits = limits_for(light);
  const double before = share;
  for (int attempt = 0;; ++attempt) {
    make_plan(block, shared, share, plan, workspace);
    const double error = largest_error(plan);
    const bool last = attempt >= 3;
    if (error > kMost) {
      if (attempt == 3) {
        // The shared plan may be the cause.
        shared = nullptr;
        share = before;
      }
      if (attempt > 6) return false;
      share *= std::max(0.1, kWanted / error);
    } else if (error < kEnough && !last && share < 1.0) {
      share *= std::min(4.0, kWanted / std::max(error, 1e-3));
    } else {
      // For the next block; this one is good enough.
      share *= std::clamp(kWanted / error, 0.9, 1.25);
      return shared != nullptr;
    }
  }
}

}  // namespace scattermeter
