#include "core/agreement/shot_agreement.h"

#include <cmath>
#include <cstdio>
#include <random>
#include <stdexcept>

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include "core/diffusion/dipole_curve.h"
#include "core/fit/dipole_fit.h"
#include "tests/fixtures/core/free_scale.h"
#include "tests/fixtures/core/plate_system.h"

namespace scattermeter {
namespace {

using test_support::kEta;
using test_support::kFree;
using test_support::plate;

// Shots of these media, with noise of 1 % a row, one below the other. Two nuisances move them all:
// a tilt of the light along x that is fitted, and one in y that is not.
struct Shots {
  double tilt_std = 0;  // 0: no nuisances
  double held_std = 0;
  double scale_std = 0;

  DenseSystem draw(const std::vector<Medium>& media, unsigned seed) const {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    const Eigen::Index n = plate().w.rows();
    const auto shots = static_cast<Eigen::Index>(media.size());
    DenseSystem s{WeightMatrix(n * shots, plate().w.cols()), Eigen::VectorXd(n * shots),
                  Eigen::VectorXd(n * shots)};
    const double scale =
        std::isfinite(scale_std) ? std::exp(scale_std * normal(random)) : std::exp(1.0);
    const double tilt = tilt_std * normal(random);
    const double held = held_std * normal(random);
    if (tilt_std > 0.0) {
      s.nuisances = {{"tilt", tilt_std, true}, {"method", held_std, false}};
      s.nuisance_columns.resize(n * shots, 2);
    }
    for (Eigen::Index i = 0; i < shots; ++i) {
      const Eigen::VectorXd l = scale * plate().image(media[static_cast<std::size_t>(i)]);
      s.weights.middleRows(i * n, n) = plate().w;
      s.shot_rows.push_back(n);
      for (Eigen::Index j = 0; j < n; ++j) {
        const Eigen::Vector3d at =
            plate().plate.patches().center_mm(plate().plate.rows()[static_cast<std::size_t>(j)]);
        const Eigen::Index row = i * n + j;
        s.l[row] = l[j];
        if (tilt_std > 0.0) {
          // The shots' lights stand opposite each other.
          const double side = i % 2 == 0 ? 1.0 : -1.0;
          s.nuisance_columns.row(row) << side * l[j] * at.x() / 15.0, side * l[j] * at.y() / 3.0;
          s.l[row] += s.nuisance_columns(row, 0) * tilt + s.nuisance_columns(row, 1) * held;
        }
        s.std_l[row] = 0.01 * (l[j] + 0.01 * l.maxCoeff());
        s.l[row] += s.std_l[row] * normal(random);
      }
    }
    return s;
  }

  ShotAgreement agreement(const DenseSystem& s) const {
    DipoleFitOptions options;
    options.eta_int_over_ext = kEta;
    options.scale.relative_std = scale_std;
    const DipoleFit fit = fit_dipole(s, plate().knots, options);
    EXPECT_TRUE(fit.estimate.converged);
    return shot_agreement(information_by_shot(SystemRows(s)), s.nuisances, plate().knots,
                          fit.optimum, kEta, options.scale, 1.0);
  }
};

// p-values of agreeing shots are even: a mean of 200 is known to 0.020, a share of 5 % to 1.5 %;
// four of each.
void expect_even(const Shots& shots, const std::vector<Medium>& media) {
  constexpr int kSeeds = 200;
  double mean = 0.0, chi2 = 0.0;
  int low = 0;
  ShotAgreement a;
  for (unsigned seed = 1; seed <= kSeeds; ++seed) {
    a = shots.agreement(shots.draw(media, seed));
    mean += a.p_value / kSeeds;
    chi2 += a.chi2 / kSeeds;
    low += a.p_value < 0.05 ? 1 : 0;
  }
  std::printf("%zu shots: mean p %.3f, %d of %d below 0.05, chi-square %.2f for %d\n", media.size(),
              mean, low, kSeeds, chi2, a.dof);
  EXPECT_EQ(a.dof, static_cast<int>(2 * media.size() - 2));
  EXPECT_NEAR(mean, 0.5, 0.082);
  EXPECT_NEAR(static_cast<double>(low) / kSeeds, 0.05, 0.062);
  EXPECT_NEAR(chi2 / a.dof, 1.0, 4.0 * std::sqrt(2.0 / a.dof / kSeeds));
}

const Medium kMedium{1.2, 0.004, kEta};

TEST(ShotAgreement, OfAgreeingShotsIsEven) {
  for (double scale_std : {0.0, 0.02, kFree}) {
    expect_even({0.0, 0.0, scale_std}, {kMedium, kMedium});
  }
  expect_even({}, {kMedium, kMedium, kMedium});
}

// Beside no absorption the optimum is on its bound half of the time.
TEST(ShotAgreement, OfShotsWithoutAbsorptionIsEven) {
  expect_even({}, {{1.2, 0.0, kEta}, {1.2, 0.0, kEta}});
}

// Were the nuisances not known of, most shots would disagree: what moves them is many times what
// the noise does.
TEST(ShotAgreement, SharedNuisancesAreForgiven) {
  const Shots shots{0.05, 0.05, 0.02};
  expect_even(shots, {kMedium, kMedium});
  int disagree = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    DenseSystem drawn = shots.draw({kMedium, kMedium}, seed);
    drawn.nuisances.clear();
    drawn.nuisance_columns.resize(0, 0);
    disagree += shots.agreement(drawn).p_value < 1e-3 ? 1 : 0;
  }
  std::printf("%d of 20 disagree with the nuisances unknown\n", disagree);
  EXPECT_GE(disagree, 12);
}

// A nuisance stated as exact is listed, to be tested, and does not move.
TEST(ShotAgreement, ExactNuisancesAreHeld) { expect_even({0.05, 0.0, 0.02}, {kMedium, kMedium}); }

TEST(ShotAgreement, FindsTheShotOfAnotherMaterial) {
  for (const Shots& shots :
       {Shots{}, Shots{0.05, 0.05, 0.02}, Shots{0.05, 0.0, 0.02}, Shots{0.0, 0.0, kFree}}) {
    for (unsigned seed = 1; seed <= 5; ++seed) {
      const DenseSystem drawn =
          shots.draw({kMedium, {1.05 * kMedium.sigma_s_prime_per_mm, 0.004, kEta}}, seed);
      EXPECT_LT(shots.agreement(drawn).p_value, 1e-6) << shots.scale_std;
    }
  }
}

// Declared noise twice as large halves twice.
TEST(ShotAgreement, InflationDividesTheChiSquare) {
  const Shots shots;
  const DenseSystem s = shots.draw({kMedium, {1.26, 0.004, kEta}}, 1);
  DipoleFitOptions options;
  options.eta_int_over_ext = kEta;
  const DipoleFit fit = fit_dipole(s, plate().knots, options);
  const double one = shot_agreement(information_by_shot(SystemRows(s)), s.nuisances, plate().knots,
                                    fit.optimum, kEta, {0.0}, 1.0)
                         .chi2;
  const double four = shot_agreement(information_by_shot(SystemRows(s)), s.nuisances, plate().knots,
                                     fit.optimum, kEta, {0.0}, 4.0)
                          .chi2;
  EXPECT_NEAR(one / four, 4.0, 1e-6);
}

TEST(ShotAgreement, OfOneShotSaysNothing) {
  const Shots shots;
  const ShotAgreement a = shots.agreement(shots.draw({kMedium}, 1));
  EXPECT_EQ(a.dof, 0);
  EXPECT_EQ(a.chi2, 0.0);
  EXPECT_EQ(a.p_value, 1.0);
}

// Answers of four shots that share an error: their chi-square about the best common value is that
// of six degrees of freedom, however large what they share.
TEST(AgreementOf, IsChiSquare) {
  constexpr int kShots = 4, kDraws = 4000;
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  Eigen::MatrixXd own(2 * kShots, 2 * kShots), shared(2 * kShots, 2);
  own.setZero();
  for (int i = 0; i < kShots; ++i) {
    const double s = 0.01 * (1 + i), a = 1e-4 * (4 - i);
    own.block<2, 2>(2 * i, 2 * i) << s * s, 0.6 * s * a, 0.6 * s * a, a * a;
    shared.block<2, 2>(2 * i, 0) << 0.05, 0.0, 2e-4, 1e-3;
  }
  const Eigen::MatrixXd covariance = own + shared * shared.transpose();
  const Eigen::MatrixXd factor = own.llt().matrixL();
  double mean = 0.0;
  int below = 0;
  for (int d = 0; d < kDraws; ++d) {
    Eigen::VectorXd z(2 * kShots);
    for (double& v : z) v = normal(random);
    Eigen::VectorXd answers = factor * z + shared * Eigen::Vector2d(normal(random), normal(random));
    for (int i = 0; i < kShots; ++i) answers.segment<2>(2 * i) += Eigen::Vector2d(0.7, 0.004);
    const ShotAgreement agreement = agreement_of(answers, covariance);
    EXPECT_EQ(agreement.dof, 6);
    mean += agreement.chi2 / kDraws;
    below += agreement.p_value < 0.05 ? 1 : 0;
    if (d > 0) continue;
    answers[2] += 0.4;
    EXPECT_TRUE(agreement_of(answers, covariance).disagree());
  }
  EXPECT_NEAR(mean, 6.0, 4.0 * std::sqrt(12.0 / kDraws));
  EXPECT_NEAR(below / static_cast<double>(kDraws), 0.05, 4.0 * std::sqrt(0.05 * 0.95 / kDraws));
  EXPECT_EQ(agreement_of(Eigen::Vector2d(1, 2), Eigen::Matrix2d::Identity()).dof, 0);
  EXPECT_THROW(agreement_of(Eigen::Vector2d(1, 2), Eigen::Matrix3d::Identity()),
               std::invalid_argument);
}

}  // namespace
}  // namespace scattermeter
