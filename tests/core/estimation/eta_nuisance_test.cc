#include "core/estimation/eta_nuisance.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <random>

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

// A change of the paths' light that is made of the terms is told as these: those of the medium for
// themselves, the others and what is observed in the column. Light of half the power has half the
// change.
TEST(EtaNuisance, ExpressesTheChangeOfPaths) {
  const EtaCube c;
  EtaNuisance nuisance(c.channel, c.by_dipole);
  nuisance.set_rows(c.rows, c.kept);
  const Eigen::VectorXd observed = c.observed();
  EXPECT_GT(observed.minCoeff(), 0.1);  // less light gets out
  const Eigen::VectorXd other = -0.3 * c.smooth.l + 0.6 * (c.by_dipole + observed);
  const Eigen::VectorXd medium = -1.1 * c.smooth.per_log_sigma_s + 0.02 * c.smooth.per_sigma_a;
  const EtaNuisance::Change all =
      nuisance.change(c.parts, c.smooth, 1.0, false, c.smooth.l, Eigen::VectorXd(other + medium));
  EXPECT_NEAR(all.as_medium[0], -1.1, 1e-8);
  EXPECT_NEAR(all.as_medium[1], 0.02, 1e-9);
  EXPECT_EQ(all.as_medium[2], 0.0);
  EXPECT_LT((all.column - (other - observed)).norm(), 1e-8 * observed.norm());
  const EtaNuisance::Change half =
      nuisance.change(c.parts, c.smooth, 1.0, false, Eigen::VectorXd(0.5 * c.smooth.l),
                      Eigen::VectorXd(0.5 * (other + medium)));
  EXPECT_NEAR(half.as_medium[0], -1.1, 1e-8);
  const EtaNuisance::Change free =
      nuisance.change(c.parts, c.smooth, 1.0, true, c.smooth.l, Eigen::VectorXd(other + medium));
  EXPECT_NEAR(free.as_medium[2], -0.3, 1e-8);
  EXPECT_LT((free.column - (other - observed + 0.3 * c.smooth.l)).norm(), 1e-8 * observed.norm());
}

// Noise of the paths makes the change of the medium uncertain: the mean square of what is told is
// that of the change plus the variance of the estimates, which themselves vary by as much.
TEST(EtaNuisance, ChangesOfTheMediumHoldTheirUncertainty) {
  const EtaCube c;
  EtaNuisance nuisance(c.channel, c.by_dipole);
  nuisance.set_rows(c.rows, c.kept);
  const Eigen::VectorXd medium = -1.1 * c.smooth.per_log_sigma_s + 0.02 * c.smooth.per_sigma_a;
  std::mt19937 random(5);
  std::normal_distribution<double> normal(0.0, 1.0);
  constexpr int kDraws = 400;
  Eigen::Vector2d told = Eigen::Vector2d::Zero(), fitted_variance = Eigen::Vector2d::Zero();
  Eigen::MatrixXd terms(c.smooth.l.size(), 4);
  const Eigen::VectorXd observed = c.observed();
  terms << c.smooth.per_log_sigma_s, c.smooth.per_sigma_a, c.smooth.l, c.by_dipole + observed;
  Eigen::MatrixXd of_parts(c.parts.n_parts(), 4);
  for (Eigen::Index k = 0; k < 4; ++k) of_parts.col(k) = c.parts.of_parts(terms.col(k));
  const Eigen::ArrayXd light = of_parts.col(2).array();
  of_parts.array().colwise() /= light;
  const Eigen::MatrixXd inverse = (of_parts.transpose() * of_parts).inverse();
  for (int i = 0; i < kDraws; ++i) {
    Eigen::VectorXd noise(c.smooth.l.size());
    for (double& x : noise) x = normal(random);
    const Eigen::Vector2d m =
        nuisance.change(c.parts, c.smooth, 1.0, false, c.smooth.l, Eigen::VectorXd(medium + noise))
            .as_medium.head<2>();
    told += m.cwiseAbs2() / kDraws;
    const Eigen::VectorXd of_noise = c.parts.of_parts(noise).cwiseQuotient(light.matrix());
    const Eigen::Vector4d moved = inverse * (of_parts.transpose() * of_noise);
    fitted_variance += moved.head<2>().cwiseAbs2() / kDraws;
  }
  for (Eigen::Index k = 0; k < 2; ++k) {
    const double b = k == 0 ? -1.1 : 0.02;
    EXPECT_NEAR((told[k] - b * b) / (2.0 * fitted_variance[k]), 1.0, 0.25) << k;
  }
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
  const EtaNuisance::Change change =
      nuisance.change(parts, smooth, 1.0, false, smooth.l, Eigen::VectorXd(-0.5 * smooth.l));
  EXPECT_EQ(change.column.size(), smooth.l.size());
  EXPECT_NEAR(change.as_medium[0], 0.0, 1e-8);
}

}  // namespace
}  // namespace scattermeter
