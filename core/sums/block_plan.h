// The plan of what is summed for a block of rows, and a bound of what that leaves out.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/sums/cluster_selection.h"
#include "core/sums/row_blocks.h"

namespace scattermeter {

// The clusters that neighbouring blocks of rows have in common.
struct SharedPlan {
  std::vector<AcceptedSeries> accepted;
  std::vector<std::int32_t> open;    // left to each block
  std::vector<PerQuantity> dropped;  // bounds of the light of clusters left out, by medium
  std::vector<PerQuantity> limits;   // the least of the blocks', by medium
  RowRegion region;
};

// A bound of the light that is left out: of whole clusters; and by series, for each row, in units
// of the limits that they were selected for.
struct LeftOut {
  std::vector<PerQuantity> dropped;
  std::vector<PerQuantity> limits;
  alignas(64) std::array<double, kRowLanes> series;

  // Of a medium, a quantity and a row.
  double error(std::size_t m, std::size_t q, std::size_t row) const {
    return dropped[m][q] + limits[m][q] * series[row];
  }
};

struct BlockPlan {
  // Consecutive points of one bucket, summed one by one.
  struct Run {
    std::int32_t bucket = -1, first = 0, last = 0;
  };
  std::vector<PerQuantity> limits;       // the largest error allowed, by medium
  std::vector<AcceptedSeries> accepted;  // the block's own, beside those of the shared plan
  std::vector<Run> runs;
  LeftOut shared, own;

  double error(std::size_t m, std::size_t q, std::size_t row) const {
    return shared.error(m, q, row) + own.error(m, q, row);
  }
};

// Makes plans. Thread-safe, as ClusterSelection; the sources must outlive it.
class BlockPlanner {
 public:
  // The memory of one thread.
  struct Workspace {
    ClusterSelection::Workspace selection;
    std::vector<std::int32_t> open;
    std::vector<LaneRest> lane_rests;
  };

  // Precondition: at least one dipole and one source.
  BlockPlanner(const SourceClusters& sources, std::span<const KernelDipole> dipoles,
               double tolerance)
      : sources_(sources),
        media_(dipoles.size()),
        tolerance_(tolerance),
        selection_(sources, dipoles) {}

  const ClusterSelection& selection() const { return selection_; }

  // light: what the rows of each block receive, by medium. share: of the limits, for one cluster.
  SharedPlan plan_shared(std::span<const RowBlocks::Block> blocks,
                         std::span<const std::vector<PerQuantity>> light, double share,
                         Workspace& workspace) const;
  // All points one by one.
  void plan_direct(BlockPlan& plan) const;
  // A plan that uses most of the tolerance for rows that receive `light`, by fitting the share.
  // Falls back to a plan without what is shared, where `shared` is given. Whether the plan is to be
  // summed together with the shared series.
  bool fit(const RowBlocks::Block& block, const std::vector<PerQuantity>& light,
           const SharedPlan* shared, double& share, BlockPlan& plan, Workspace& workspace) const;

 private:
  void clear(BlockPlan& plan) const;
  void add_run(const ClusterNode& leaf, BlockPlan& plan) const;
  void add_rests(const RowBlocks::Block& block, std::span<const AcceptedSeries> accepted,
                 LeftOut& left_out, Workspace& workspace) const;
  void make_plan(const RowBlocks::Block& block, const SharedPlan* shared, double share,
                 BlockPlan& plan, Workspace& workspace) const;
  double largest_error(const BlockPlan& plan) const;
  std::vector<PerQuantity> limits_for(const std::vector<PerQuantity>& light) const;

  const SourceClusters& sources_;
  std::size_t media_;
  double tolerance_;
  ClusterSelection selection_;
};

}  // namespace scattermeter
