#include "core/sums/dipole_sums.h"

#include <algorithm>
#include <array>
#include <limits>
#include <sstream>
#include <stdexcept>

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include "core/material/dipole.h"
#include "core/sums/block_plan.h"

namespace scattermeter {
namespace {

// Single precision is sufficient for buckets of a radius below this many distances to the pole.
constexpr double kFloatReach = 16.0;
// Blocks whose far clusters are found together.
constexpr std::size_t kTogether = 8;
// Blocks that are summed in sequence, each starting from the share fitted to the one before.
constexpr std::size_t kInTurn = 32;
// Share of the tolerance that a single cluster may use up for a typical row of a block, at first;
// then as much as fits.
constexpr double kShare = 1.0 / 16.0;

// The number of coefficients of a series, planar or not, by degree.
constexpr auto kCoefficients = [] {
  std::array<std::array<std::int64_t, std::size(kDegrees)>, 2> count{};
  for (std::size_t planar = 0; planar < 2; ++planar) {
    for (std::size_t i = 0; i < std::size(kDegrees); ++i) {
      count[planar][i] =
          static_cast<std::int64_t>(coefficient_index(kDegrees[i] + 1, 0, planar == 1));
    }
  }
  return count;
}();

class BlockSums {
 public:
  BlockSums(const SourceClusters& sources, std::span<const Medium> media,
            std::span<const KernelDipole> dipoles, const DipoleSumsOptions& options)
      : sources_(sources),
        media_(media),
        dipoles_(dipoles),
        tolerance_(options.tolerance),
        planner_(sources, dipoles, options.tolerance),
        direct_(sources.size() <= options.direct_up_to) {}

  // Sums for neighbouring blocks of rows.
  DipoleSumsCount sum(std::span<const RowBlocks::Block> blocks,
                      std::span<const std::uint32_t> order,
                      std::span<std::vector<DipoleSum>> out) const {
    State s;
    s.sums.resize(media_.size());
    s.share = kShare;
    for (std::size_t first = 0; first < blocks.size(); first += kTogether) {
      const auto together = blocks.subspan(first, std::min(kTogether, blocks.size() - first));
      std::vector<std::vector<PerQuantity>> light(together.size(),
                                                  std::vector<PerQuantity>(media_.size()));
      SharedPlan shared;
      if (!direct_) {
        for (std::size_t b = 0; b < together.size(); ++b) {
          light[b] = planner_.selection().estimate_light(
              {together[b].center_mm, together[b].radius_mm}, s.workspace.selection);
        }
        shared = planner_.plan_shared(together, light, s.share, s.workspace);
      }
      for (std::size_t b = 0; b < together.size(); ++b) {
        const RowBlocks::Block& block = together[b];
        sum_block(s, block, order.subspan(block.first, block.count), light[b], shared, out);
      }
    }
    s.count.tests = s.workspace.selection.tests;
    s.count.dropped = s.workspace.selection.dropped;
    return s.count;
  }

 private:
  struct State {
    double share;  // of the limits, that a cluster may use up
    std::vector<LaneSums> sums;
    BlockPlan plan;
    BlockPlanner::Workspace workspace;
    std::vector<KernelSeries> series;
    std::vector<KernelPoints> points;
    DipoleSumsCount count;
  };

  // light: an estimate of what the rows receive, by medium.
  void sum_block(State& s, const RowBlocks::Block& block, std::span<const std::uint32_t> rows,
                 std::vector<PerQuantity>& light, const SharedPlan& shared,
                 std::span<std::vector<DipoleSum>> out) const {
    s.count.rows += static_cast<std::int64_t>(block.count);
    double worst = 0.0;
    // One exceptional block is not to slow down those after it.
    const double least_share = 0.3 * s.share;
    for (int attempt = 0;; ++attempt) {
      s.sums.assign(media_.size(), {});
      if (direct_ || attempt > 4) {
        planner_.plan_direct(s.plan);
      } else if (planner_.fit(block, light, attempt == 0 ? &shared : nullptr, s.share, s.plan,
                              s.workspace)) {
        add_series(s, block, shared.accepted);
      }
      add_series(s, block, s.plan.accepted);
      add_points(s, block);
      worst = worst_error(s, block, light);
      if (worst <= tolerance_) break;
      ++s.count.repeated_blocks;
      s.share *= std::min(0.7, 0.7 * tolerance_ / worst);
    }
    s.share = std::max(s.share, least_share);
    s.count.certified_error = std::max(s.count.certified_error, worst);
    const double scale = sources_.weight();
    for (std::size_t m = 0; m < media_.size(); ++m) {
      const LaneSums& sums = s.sums[m];
      for (std::size_t i = 0; i < block.count; ++i) {
        out[m][rows[i]] = dipole_sum(media_[m], {scale * sums.value[i], scale * sums.z_d_z[i],
                                                 -0.5 * scale * sums.decay[i]});
      }
    }
  }

  // The largest error bound over what the rows received; sets `light` to the least they received.
  double worst_error(const State& s, const RowBlocks::Block& block,
                     std::vector<PerQuantity>& light) const {
    double worst = 0.0;
    for (std::size_t m = 0; m < media_.size(); ++m) {
      const PerQuantity floor = planner_.selection().least_light(m);
      PerQuantity least;
      least.fill(std::numeric_limits<double>::infinity());
      for (std::size_t i = 0; i < block.count; ++i) {
        const double value = s.sums[m].value[i];
        // z psi_1 + z^3 psi_2, by z_d_z = z psi_1 - z^3 psi_2.
        const PerQuantity sum = {value, 2.0 * value - s.sums[m].z_d_z[i], s.sums[m].decay[i]};
        PerQuantity error;
        for (std::size_t q = 0; q < 3; ++q) error[q] = s.plan.error(m, q, i);
        for (std::size_t q = 0; q < 3; ++q) {
          // The sums themselves are known up to their errors.
          const double received =
              std::max(sum[q] - error[q] - (q == 1 ? 2.0 * error[0] : 0.0), floor[q]);
          least[q] = std::min(least[q], received);
          worst = std::max(worst, error[q] / received);
        }
      }
      light[m] = least;
    }
    return worst;
  }

  void add_series(State& s, const RowBlocks::Block& block,
                  std::span<const AcceptedSeries> accepted) const {
    s.series.clear();
    const auto rows = static_cast<std::int64_t>(block.count);
    s.count.series += rows * static_cast<std::int64_t>(accepted.size());
    for (const AcceptedSeries& as : accepted) {
      const ClusterNode& node = sources_.nodes()[static_cast<std::size_t>(as.node)];
      const int degree = kDegrees[as.series];
      s.series.push_back({sources_.cluster(node), degree, node.weight});
      if (degree == 1) {
        s.series.back().cluster.radius_mm =
            distance_mm(node, block.center_mm) + planner_.selection().farthest_pole_mm();
      }
      s.count.coefficients += rows * kCoefficients[node.planar][as.series];
    }
    add_cluster_sums(dipoles_, block.lanes, s.series, s.sums);
  }

  void add_points(State& s, const RowBlocks::Block& block) const {
    const double reach = kFloatReach * kFloatReach;
    const double pole = planner_.selection().bounds().nearest_pole_mm();
    s.points.clear();
    for (const BlockPlan::Run& run : s.plan.runs) {
      const ClusterNode& bucket = sources_.nodes()[static_cast<std::size_t>(run.bucket)];
      const auto pairs = static_cast<std::int64_t>(block.count) * (run.last - run.first);
      s.count.pairs += pairs;
      const double d =
          std::max(0.0, distance_mm(bucket, block.center_mm) - block.radius_mm - bucket.radius_mm);
      if (bucket.radius_mm * bucket.radius_mm <= reach * (d * d + pole * pole)) {
        s.points.push_back(sources_.points(run.bucket, run.first, run.last));
      } else {
        s.count.exact_pairs += pairs;
        sources_.add_exact_sums(run.first, run.last, dipoles_, block.lanes, s.sums);
      }
    }
    add_point_sums(dipoles_, block.lanes, s.points, 1.0, s.sums);
  }

  const SourceClusters& sources_;
  std::span<const Medium> media_;
  std::span<const KernelDipole> dipoles_;
  double tolerance_;
  BlockPlanner planner_;
  bool direct_;
};

void add_count(const DipoleSumsCount& c, DipoleSumsCount& total) {
  total.rows += c.rows;
  total.pairs += c.pairs;
  total.exact_pairs += c.exact_pairs;
  total.series += c.series;
  total.coefficients += c.coefficients;
  total.dropped += c.dropped;
  total.tests += c.tests;
  total.repeated_blocks += c.repeated_blocks;
  total.certified_error = std::max(total.certified_error, c.certified_error);
}

}  // namespace

DipoleSumsCount sum_dipoles(const SourceClusters& sources, const RowBlocks& rows,
                            std::span<const Medium> media, std::span<std::vector<DipoleSum>> out,
                            const DipoleSumsOptions& options) {
  if (!(options.tolerance >= 1e-5 && options.tolerance <= 0.5)) {
    std::ostringstream text;
    text << "sum_dipoles: tolerance " << options.tolerance << " not in 1e-5 .. 0.5";
    throw std::invalid_argument(text.str());
  }
  bool sized = out.size() == media.size();
  for (const auto& o : out) sized = sized && o.size() == rows.size();
  if (!sized) throw std::invalid_argument("sum_dipoles: outputs are not media times rows");
  std::vector<KernelDipole> dipoles;
  for (const Medium& m : media) {
    const Dipole dipole(m);
    dipoles.push_back({dipole.z_r_mm(), dipole.z_v_mm(), dipole.sigma_tr_per_mm()});
  }
  DipoleSumsCount total;
  if (media.empty() || rows.size() == 0 || sources.empty()) {
    for (auto& o : out) std::fill(o.begin(), o.end(), DipoleSum{});
    total.rows = static_cast<std::int64_t>(rows.size());
  } else {
    const BlockSums sums(sources, media, dipoles, options);
    const std::span<const RowBlocks::Block> blocks = rows.blocks();
    std::vector<DipoleSumsCount> counts((blocks.size() + kInTurn - 1) / kInTurn);
    oneapi::tbb::parallel_for(
        oneapi::tbb::blocked_range<std::size_t>(0, counts.size(), 1), [&](const auto& range) {
          for (std::size_t i = range.begin(); i != range.end(); ++i) {
            const std::size_t first = i * kInTurn;
            counts[i] = sums.sum(blocks.subspan(first, std::min(kInTurn, blocks.size() - first)),
                                 rows.order(), out);
          }
        });
    for (const DipoleSumsCount& c : counts) add_count(c, total);
    total.certified_error += kDipoleSumsRounding;
  }
  total.points = static_cast<std::int64_t>(sources.size());
  total.points_left_out = static_cast<std::int64_t>(sources.left_out());
  return total;
}

}  // namespace scattermeter
