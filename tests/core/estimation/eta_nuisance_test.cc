#include "core/estimation/eta_nuisance.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

#include <gtest/gtest.h>

#include "core/material/eta_change.h"
#include "tests/fixtures/core/dipole_cube.h"

namespace scattermeter {
namespace {

struct EtaCube : test_support::DipoleCube {
  EtaCube() : DipoleCube(1, 2.5) {
    show({0.9, 0.01, 1.3});
    channel = material_channels(scene, shots, "R").front();
    rows = channel_rows(scene, channel);
    std::vector<Eigen::Vector3d> center_mm;
    std::vector<double> area_mm2;
    const SeenObject& seen = *shots[0].seen;
    for (ChannelObservation& o : rows) {
      std::fill(o.state.begin(), o.state.end(), RowState::kUsed);
      for (std::size_t j = 0; j < o.state.size(); ++j) {
        const int patch = seen.map.patch_of_row[j];
        center_mm.push_back(seen.patches->center_mm(patch));
        area_mm2.push_back(seen.patches->area_mm2(patch));
      }
    }
    const auto n = static_cast<Eigen::Index>(center_mm.size());
    kept.resize(center_mm.size());
    std::iota(kept.begin(), kept.end(), Eigen::Index{0});
    smooth.l = Eigen::VectorXd::Ones(n);
    smooth.per_log_sigma_s.resize(n);
    smooth.per_sigma_a.resize(n);
    by_dipole.resize(n);
    for (Eigen::Index j = 0; j < n; ++j) {
      const Eigen::Vector3d& at_mm = center_mm[static_cast<std::size_t>(j)];
      smooth.l[j] += 0.02 * at_mm.x();
      smooth.per_log_sigma_s[j] = 0.2 + 0.03 * at_mm.y();
      smooth.per_sigma_a[j] = -5.0 - 0.01 * at_mm.squaredNorm();
      by_dipole[j] = -0.8 + 0.004 * at_mm.x() * at_mm.z();
    }
    parts = ShotParts({n}, center_mm, area_mm2, smooth.l);
  }
  // Change of the observed l by eta.
  Eigen::VectorXd observed() const {
    Eigen::VectorXd out(smooth.l.size());
    for (Eigen::Index j = 0; j < out.size(); ++j) {
      const double cosine = shots[0].seen->cos_to_camera(static_cast<std::size_t>(j));
      out[j] = observed_growth(1.3, cosine) * smooth.l[j];
    }
    return out;
  }
  MaterialChannel channel;
  ChannelRows rows;
  std::vector<Eigen::Index> kept;
  ScatteringImage smooth;
  Eigen::VectorXd by_dipole;
  ShotParts parts;
};

// Of a change of the paths' light that is made of the terms, the column is what is not of the
// medium, minus what is observed, whatever the noise; all of the change has the noise. Light of
// half the power has half the change.
TEST(EtaNuisance, ColumnIsTheChangeBesideTheMedium) {
  const EtaCube c;
  EtaNuisance nuisance(c.channel, c.by_dipole);
  nuisance.set_rows(c.rows, c.kept);
  const Eigen::VectorXd observed = c.observed();
  EXPECT_GT(observed.minCoeff(), 0.1);  // less light gets out
  const Eigen::VectorXd other = -0.3 * c.smooth.l + 0.6 * (c.by_dipole + observed);
  const Eigen::VectorXd medium = -1.1 * c.smooth.per_log_sigma_s + 0.02 * c.smooth.per_sigma_a;
  const Eigen::VectorXd change = other + medium;
  const auto column = [&](double share, bool scale_is_free) {
    return nuisance.column(c.parts, c.smooth, 1.0, scale_is_free, share * c.smooth.l,
                           share * change);
  };
  for (const double share : {1.0, 0.5}) {
    EXPECT_LT((column(share, false) - (other - observed)).norm(), 1e-8 * observed.norm());
  }
  EXPECT_LT((column(1.0, true) - (other - observed + 0.3 * c.smooth.l)).norm(),
            1e-8 * observed.norm());
  EXPECT_LT((nuisance.change(c.smooth, 0.7, change) - 0.7 * (change - observed)).norm(),
            1e-12 * observed.norm());
}

// Rows that are left out are left out of the dipole's change as well.
TEST(EtaNuisance, FollowsTheRows) {
  EtaCube c;
  EtaNuisance nuisance(c.channel, c.by_dipole);
  nuisance.set_rows(c.rows, c.kept);
  c.kept.erase(c.kept.begin());
  c.rows[0].state[0] = RowState::kOutlier;
  nuisance.set_rows(c.rows, c.kept);
  const auto some = [&](const Eigen::VectorXd& x) -> Eigen::VectorXd {
    return x.tail(x.size() - 1);
  };
  const ScatteringImage smooth{
      some(c.smooth.l), some(c.smooth.per_log_sigma_s), some(c.smooth.per_sigma_a), {}};
  std::vector<Eigen::Vector3d> center_mm;
  std::vector<double> area_mm2;
  const SeenObject& seen = *c.shots[0].seen;
  for (std::size_t j = 1; j < c.rows[0].state.size(); ++j) {
    center_mm.push_back(seen.patches->center_mm(seen.map.patch_of_row[j]));
    area_mm2.push_back(seen.patches->area_mm2(seen.map.patch_of_row[j]));
  }
  const ShotParts parts({smooth.l.size()}, center_mm, area_mm2, smooth.l);
  const Eigen::VectorXd column =
      nuisance.column(parts, smooth, 1.0, false, smooth.l, Eigen::VectorXd(-0.5 * smooth.l));
  EXPECT_LT((column - some(Eigen::VectorXd(-0.5 * c.smooth.l - c.observed()))).norm(),
            1e-8 * column.norm());
}

}  // namespace
}  // namespace scattermeter
