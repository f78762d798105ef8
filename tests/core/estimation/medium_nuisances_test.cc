#include "core/estimation/medium_nuisances.h"

#include <algorithm>
#include <numeric>

#include <gtest/gtest.h>

#include "tests/fixtures/core/dipole_cube.h"

namespace scattermeter {
namespace {

// A search's system of a cube: gamma, and eta where `with_eta`, before another nuisance.
struct MediumCube : test_support::DipoleCube {
  explicit MediumCube(bool with_eta) : DipoleCube(1, 2.5) {
    show({0.9, 0.01, 1.3});
    channel = material_channels(scene, shots, "R").front();
    rows = channel_rows(scene, channel);
    for (ChannelObservation& o : rows) {
      std::fill(o.state.begin(), o.state.end(), RowState::kUsed);
    }
    system = channel_system(scene, channel, rows, weights, 0.0);
    system.nuisances = {{"phase function", 0.5, true, "gamma"}};
    if (with_eta) system.nuisances.push_back({"eta", 0.03, true, "eta"});
    system.nuisances.push_back({"scale", 0.02, true, "other"});
    const auto n = static_cast<Eigen::Index>(system.nuisances.size());
    system.nuisance_columns = system.l.replicate(1, n);
    kept.resize(static_cast<std::size_t>(system.l.size()));
    std::iota(kept.begin(), kept.end(), Eigen::Index{0});
    std::vector<Eigen::Vector3d> center_mm;
    std::vector<double> area_mm2;
    const SeenObject& seen = *shots[0].seen;
    for (const int patch : seen.map.patch_of_row) {
      center_mm.push_back(seen.patches->center_mm(patch));
      area_mm2.push_back(seen.patches->area_mm2(patch));
    }
    parts = ShotParts(system.shot_rows, center_mm, area_mm2, system.l);
    smooth.l = system.l;
    smooth.per_log_sigma_s = 0.3 * system.l;
    smooth.per_log_sigma_s.head(system.l.size() / 2) *= 0.5;
    smooth.per_sigma_a = -4.0 * system.l;
    smooth.per_sigma_a.tail(system.l.size() / 3) *= 1.4;
  }
  MaterialChannel channel;
  ChannelRows rows;
  DenseSystem system;
  std::vector<Eigen::Index> kept;
  ShotParts parts;
  ScatteringImage smooth;
};

TEST(MediumNuisances, SetsTheColumnsThatDependOnThePoint) {
  const ScatteringPoint at{0.9, 0.01, 1.0};
  for (const bool with_eta : {true, false}) {
    MediumCube c(with_eta);
    const DistanceKnots knots = smooth_knots(c.lit);
    const DenseSystem before = c.system;
    MediumNuisances medium(c.scene, c.channel, knots, c.system);
    medium.set_rows(c.rows, c.kept);
    const Eigen::VectorXd per_eta = -0.9 * c.smooth.per_log_sigma_s;
    medium.set_columns(at, false, {}, c.parts, c.smooth, c.smooth.l, per_eta, c.system);
    PhaseNuisance phase(c.scene, c.channel, knots);
    phase.set_rows(c.rows);
    EXPECT_EQ(c.system.nuisance_columns.col(0), phase.change(c.system.weights, at));
    EXPECT_EQ(c.system.nuisance_columns.rightCols(1), before.nuisance_columns.rightCols(1));
    if (!with_eta) continue;
    EtaNuisance eta(c.channel, before.nuisance_columns.col(1));
    eta.set_rows(c.rows, c.kept);
    EXPECT_EQ(c.system.nuisance_columns.col(1),
              eta.column(c.parts, c.smooth, 1.0, false, c.smooth.l, per_eta));
    EXPECT_EQ(c.system.beyond_column.nuisance, 1);
    EXPECT_LT((c.system.beyond_column.l - per_eta).norm(), 1e-6 * per_eta.norm());
  }
}

// More paths change what eta does beyond its column, not the columns that weights rest on.
TEST(MediumNuisances, SeesEtaWithMorePaths) {
  const ScatteringPoint at{0.9, 0.01, 1.0};
  for (const bool with_eta : {true, false}) {
    MediumCube c(with_eta);
    const DistanceKnots knots = smooth_knots(c.lit);
    MediumNuisances medium(c.scene, c.channel, knots, c.system);
    medium.set_rows(c.rows, c.kept);
    const Eigen::VectorXd few = -0.9 * c.smooth.per_log_sigma_s;
    const Eigen::VectorXd more = -1.2 * c.smooth.per_log_sigma_s;
    medium.set_columns(at, false, {}, c.parts, c.smooth, c.smooth.l, few, c.system);
    const Eigen::MatrixXd columns = c.system.nuisance_columns;
    medium.see_eta(c.smooth, at.scale, more, c.system);
    EXPECT_EQ(c.system.nuisance_columns, columns);
    EXPECT_EQ(c.system.beyond_column.nuisance, with_eta ? 1 : -1);
    if (!with_eta) continue;
    EXPECT_LT((c.system.beyond_column.l - more).norm(), 1e-6 * more.norm());
  }
}

}  // namespace
}  // namespace scattermeter
