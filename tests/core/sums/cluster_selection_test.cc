#include "core/sums/cluster_selection.h"

#include <cmath>
#include <cstddef>
#include <vector>

#include <gtest/gtest.h>

#include "tests/fixtures/core/even_square.h"

namespace scattermeter {
namespace {

using test_support::even_square;

constexpr KernelDipole kSelectionDipole{0.5, 1.6, 0.05};

struct Selected {
  std::vector<AcceptedSeries> accepted;
  std::vector<PerQuantity> dropped{PerQuantity{}};
  std::vector<std::int32_t> open;
  std::int64_t dropped_clusters = 0;

  // Points of the clusters that are accepted or open.
  std::int32_t points(const SourceClusters& sources) const {
    std::int32_t count = 0;
    const auto add = [&](std::int32_t node) {
      const ClusterNode& n = sources.nodes()[static_cast<std::size_t>(node)];
      count += n.last - n.first;
    };
    for (const AcceptedSeries& as : accepted) add(as.node);
    for (const std::int32_t node : open) add(node);
    return count;
  }
};

Selected select(const ClusterSelection& selection, const RowRegion& region, double tolerance,
                double share) {
  ClusterSelection::Workspace workspace;
  std::vector<PerQuantity> limits = selection.estimate_light(region, workspace);
  for (double& limit : limits[0]) limit *= tolerance;
  selection.build_limit_tables(limits, region, workspace);
  workspace.nodes.assign(1, 0);
  Selected s;
  selection.select(region, {0.9, share, 0.0}, workspace, s.accepted, s.dropped, s.open);
  EXPECT_TRUE(workspace.nodes.empty());
  s.dropped_clusters = workspace.dropped;
  return s;
}

// Every point is in exactly one cluster that is summed, unless some are dropped; with smaller
// shares there are more series, or more points are left to be summed one by one.
TEST(ClusterSelection, CoversEveryPointOnce) {
  const SourceClusters sources = even_square(4000);
  const ClusterSelection selection(sources, {&kSelectionDipole, 1});
  const RowRegion region{{0.5, 0.5, 0.0}, 0.2};
  std::size_t parts = 0;
  for (const double share : {0.5, 0.05, 0.005, 5e-4}) {
    const Selected s = select(selection, region, 1e-2, share);
    if (s.dropped_clusters == 0) {
      EXPECT_EQ(s.points(sources), 4000) << share;
    }
    EXPECT_GE(s.accepted.size() + s.open.size(), parts) << share;
    parts = s.accepted.size() + s.open.size();
    EXPECT_FALSE(s.accepted.empty()) << share;
    for (const AcceptedSeries& as : s.accepted) {
      EXPECT_LT(as.series, std::size(kDegrees));
      EXPECT_GE(as.nearest_mm, kSelectionDipole.z_r_mm * (1.0 - 1e-5));
    }
  }
}

// Light that is far away and dies on its way is dropped, with a bound.
TEST(ClusterSelection, DropsWhatGivesTooLittle) {
  const SourceClusters sources = even_square(4000);
  constexpr KernelDipole kDark{0.05, 0.16, 5.0};
  const ClusterSelection selection(sources, {&kDark, 1});
  const Selected s = select(selection, {{10.0, 10.0, 0.0}, 0.1}, 1e-3, 0.01);
  EXPECT_GT(s.dropped_clusters, 0);
  EXPECT_LT(s.points(sources), 4000);
  EXPECT_GT(s.dropped[0][0], 0.0);
}

// About what the rows receive: less by a fifth, and by what a cell of distances is wide.
TEST(ClusterSelection, EstimatesTheLight) {
  const SourceClusters sources = even_square(4000);
  const ClusterSelection selection(sources, {&kSelectionDipole, 1});
  ClusterSelection::Workspace workspace;
  const Eigen::Vector3d at(3.0, -2.0, 0.0);
  const std::vector<PerQuantity> light = selection.estimate_light({at, 0.1}, workspace);
  RowLanes rows;
  for (std::size_t i = 0; i < kRowLanes; ++i) {
    rows.x[i] = at.x();
    rows.y[i] = at.y();
    rows.z[i] = at.z();
  }
  LaneSums sums{};
  sources.add_exact_sums(0, 4000, {&kSelectionDipole, 1}, rows, {&sums, 1});
  EXPECT_GT(light[0][0], 0.3 * sums.value[0]);
  EXPECT_LT(light[0][0], 1.0 * sums.value[0]);
  EXPECT_GT(light[0][2], 0.5 * sums.decay[0]);
  EXPECT_LT(light[0][2], 1.0 * sums.decay[0]);
  // Beyond any distance at which light arrives it is the least that counts.
  const auto none = selection.estimate_light({{1e7, 0.0, 0.0}, 0.1}, workspace);
  EXPECT_EQ(none[0][0], selection.least_light(0)[0]);
}

}  // namespace
}  // namespace scattermeter
