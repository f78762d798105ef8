#include "core/fit/compared_image.h"

#include <cmath>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/diffusion/dipole_curve.h"
#include "core/fit/dipole_fit.h"
#include "tests/fixtures/core/half_lit_plate.h"

namespace scattermeter {
namespace {

using test_support::HalfLitPlate;
using test_support::noisy_system;
using ::testing::HasSubstr;

constexpr double kPlateEta = 1.3;
const Medium kPlateTruth{1.2, 0.004, kPlateEta};

constexpr int kNeighbours = 8;

// A system of one shot, divided into runs of rows.
class DividedRows final : public ImageRows {
 public:
  DividedRows(const DenseSystem& system, int parts) : rows_(system), parts_(parts) {}
  std::size_t shots() const override { return 1; }
  const std::vector<Nuisance>& nuisances() const override { return rows_.nuisances(); }
  ShotSystem shot(std::size_t shot) const override {
    ShotSystem out = rows_.shot(shot);
    const auto n = static_cast<int>(out.system->l.size());
    for (int j = 0; j < n; ++j) {
      out.part_of_row.push_back(j * parts_ / n);
      out.cell_of_row.push_back(j / kNeighbours);
    }
    return out;
  }

 private:
  SystemRows rows_;
  int parts_;
};

struct Plate {
  HalfLitPlate plate{1.0};
  DistanceKnots knots = plate.knots();
  WeightMatrix weights = plate.weights(knots);
  Eigen::VectorXd l = plate.image(Dipole(kPlateTruth));

  DenseSystem system(unsigned seed) const { return noisy_system(weights, l, 0.005, seed); }
  DipoleFit fit(const ImageRows& rows) const {
    DipoleFitOptions options;
    options.eta_int_over_ext = kPlateEta;
    return fit_dipole(rows, joint_information(information_by_shot(rows), rows.nuisances().size()),
                      knots, options);
  }
};

TEST(ComparedImage, PartsAreSumsOfTheirRows) {
  const Plate plate;
  DenseSystem system = plate.system(1);
  system.nuisances = {{"tilt", 0.1, true, "tilt"}};
  system.nuisance_columns = Eigen::VectorXd::LinSpaced(system.l.size(), -1.0, 1.0);
  const DividedRows rows(system, 4);
  DipoleSolver::Point at;
  at.u = std::log(1.204);
  at.q = 0.004 / 1.204;
  at.log_s = 0.1;
  at.v = {0.02};
  const ComparedImage image = compared_image(rows, plate.knots, at, kPlateEta);
  const DipoleCurve curve = dipole_curve(plate.knots, at.u, at.q, kPlateEta);
  const Eigen::VectorXd nominal = std::exp(0.1) * (system.weights * curve.r);
  EXPECT_LT((image.predicted - nominal - 0.02 * system.nuisance_columns).norm(),
            1e-12 * nominal.norm());
  ASSERT_EQ(image.parts.residual.size(), 4);
  const Eigen::Index n = system.l.size();
  for (Eigen::Index k = 0; k < 4; ++k) {
    double l = 0, rest = 0, variance = 0, tilt = 0, by_scale = 0;
    for (Eigen::Index j = 0; j < n; ++j) {
      if (j * 4 / n != k) continue;
      l += system.l[j];
      rest += system.l[j] - nominal[j];
      variance += system.std_l[j] * system.std_l[j];
      tilt += system.nuisance_columns(j, 0);
      by_scale += nominal[j];
    }
    EXPECT_NEAR(image.parts.residual[k], rest / l, 1e-12);
    EXPECT_NEAR(image.parts.std[k], std::sqrt(variance) / l, 1e-12);
    EXPECT_NEAR(image.parts.columns(k, 0), tilt / l, 1e-9 * std::abs(tilt / l));
    EXPECT_NEAR(image.parts.free(k, 2), by_scale / l, 1e-12);
  }
}

// The misfit of the parts is chi-square distributed under the model, and one part that is 2 %
// brighter is significant while the whole image still fits to well under 1 %.
TEST(ComparedImage, MisfitOfPartsSeesOnePart) {
  const Plate plate;
  double ratio = 0.0;
  constexpr int kSeeds = 20;
  for (unsigned seed = 1; seed <= kSeeds; ++seed) {
    const DenseSystem system = plate.system(seed);
    const DividedRows rows(system, 12);
    const LackOfFit none = misfit_of_parts(plate.fit(rows).image.parts, {}, {});
    EXPECT_GT(none.p_value, 1e-4);
    ratio += none.chi2 / none.dof / kSeeds;
  }
  EXPECT_NEAR(ratio, 1.0, 4.0 * std::sqrt(2.0 / (10.0 * kSeeds)));
  DenseSystem system = plate.system(1);
  const Eigen::Index n = system.l.size();
  system.l.segment(n / 12 * 4, n / 12) *= 1.02;
  const DividedRows rows(system, 12);
  const DipoleFit fit = plate.fit(rows);
  const LackOfFit one = misfit_of_parts(fit.image.parts, {}, {});
  EXPECT_LT(one.p_value, 1e-6);
  EXPECT_NEAR(one.rms, 0.02 / std::sqrt(12.0), 0.5 * 0.02 / std::sqrt(12.0));
  EXPECT_LT(fit.estimate.rms_relative, 0.01);
  EXPECT_THAT(fit.estimate.reasons, ::testing::Contains(HasSubstr("parts of the image are")));
}

// Errors of 0.8 % that eight neighbours share, under noise of half a per cent.
TEST(ComparedImage, MisfitOfCellsSeesWhatNeighboursShare) {
  const Plate plate;
  double ratio = 0.0;
  constexpr int kSeeds = 20;
  double std_alone = 0.0;
  for (unsigned seed = 1; seed <= kSeeds; ++seed) {
    const DipoleFit fit = plate.fit(DividedRows(plate.system(seed), 12));
    const LackOfFit none = misfit_of_cells(fit.image);
    EXPECT_GT(none.p_value, 1e-4);
    ratio += none.chi2 / (none.dof - 2.0) / kSeeds;  // without those of the medium
    std_alone += fit.estimate.sigma_s_prime_per_mm.std / kSeeds;
  }
  EXPECT_NEAR(ratio, 1.0, 4.0 * std::sqrt(2.0 / (30.0 * kSeeds)));
  DenseSystem system = plate.system(1);
  std::mt19937 random(2);
  std::normal_distribution<double> normal;
  constexpr double kShared = 0.008;
  double shared = 0.0;
  for (Eigen::Index j = 0; j < system.l.size(); ++j) {
    if (j % kNeighbours == 0) shared = kShared * normal(random);
    system.l[j] *= 1.0 + shared;
  }
  const DipoleFit fit = plate.fit(DividedRows(system, 12));
  const LackOfFit found = misfit_of_cells(fit.image);
  EXPECT_LT(found.p_value, 1e-6);
  EXPECT_NEAR(found.rms, kShared, 0.3 * kShared);
  // Rows that share errors tell less: not 1.9 by the scatter of rows, but 4.6 by that of
  // the cells' means.
  EXPECT_GT(fit.estimate.sigma_s_prime_per_mm.std, 2.0 * std_alone);
  EXPECT_EQ(misfit_of_cells({}).dof, 1.0);
}

TEST(ComparedImage, UndividedShotsHaveNoParts) {
  const Plate plate;
  const DenseSystem system = plate.system(1);
  const SystemRows rows(system);
  const DipoleFit fit = plate.fit(rows);
  EXPECT_EQ(fit.image.parts.residual.size(), 0);
  EXPECT_EQ(misfit_of_parts(fit.image.parts, {}, {}).dof, 0.0);
}

}  // namespace
}  // namespace scattermeter
