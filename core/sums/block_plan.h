// The plan of the sums for a block of rows, and a bound of the light that it leaves out.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/sums/cluster_selection.h"
#include "core/sums/row_blocks.h"

namespace scattermeter {

// The clusters common to neighbouring blocks of rows.
struct SharedPlan {
  std::vector<AcceptedSeries> accepted;
  std::vector<std::int32_t> open;    // left to each block
  std::vector<PerQuantity> dropped;  // bounds of the light of clusters left out, by medium
  std::vector<PerQuantity> limits;   // the smallest of the blocks', by medium
  RowRegion region;
};

// A bound of the light that is left out: of whole clusters, and by series, for each row, in units
// of the limits for which they were selected.
struct LeftOut {
  std::vector<PerQuantity> dropped;
  std::vector<PerQuantity> limits;
  alignas(64) std::array<double, kRowLanes> series;

  // The bound for a medium, a quantity and a row.
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

  // light: received by the rows of each block, by medium. share: of the limits, for one cluster.
  SharedPlan plan_shared(std::span<const RowBlocks::Block> blocks,
                         std::span<const std::vector<PerQuantity>> light, double share,
                         Workspace& workspace) const;
  // A plan that sums all points one by one.
  void plan_direct(BlockPlan& plan) const;
  // Makes a plan that uses most of the tolerance for rows that receive `light`, by adjusting the
  // share. If `shared` is given, it may fall back to a plan without the shared series. Returns
  // whether the plan is to be summed together with the shared series.
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
