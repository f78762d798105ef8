#include "core/fit/dipole_misfit.h"

#include <cmath>
#include <cstdio>
#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

#include "core/fit/dipole_fit.h"
#include "tests/fixtures/core/plate_system.h"

namespace scattermeter {
namespace {

using test_support::noisy_system;
using test_support::plate;

DipoleMisfit misfit(const DenseSystem& system, const ScalePrior& scale) {
  DipoleFitOptions fit_options;
  fit_options.eta_int_over_ext = 1.4;
  fit_options.scale = scale;
  const Estimate e = fit_dipole(system, plate().knots, fit_options).estimate;
  DipoleMisfitOptions options;
  options.scale = scale;
  return dipole_misfit(recover_reflectance(system), system.nuisances, plate().knots,
                       {e.sigma_s_prime_per_mm.value, e.sigma_a_per_mm.value, 1.4}, e.scale.value,
                       options);
}

// Alarms among 200 true dipoles are binomial: at 5 % 10 +- 3.1, at 1 % 2 +- 1.4. Both limits are
// passed by chance once in a thousand.
TEST(DipoleMisfit, FalseAlarmsAreAsStated) {
  const Eigen::VectorXd l = plate().plate.image(Dipole({1.2, 0.004, 1.4}));
  for (double scale_std : {0.0, std::numeric_limits<double>::infinity()}) {
    int at_5 = 0, at_1 = 0;
    double drop = 0.0, dof = 0.0;
    for (unsigned seed = 1; seed <= 200; ++seed) {
      const DipoleMisfit m = misfit(noisy_system(plate().w, l, 0.01, seed), {scale_std});
      ASSERT_TRUE(m.reasons.empty());
      at_5 += m.p_value < 0.05 ? 1 : 0;
      at_1 += m.p_value < 0.01 ? 1 : 0;
      drop += m.chi2_drop / 200.0;
      dof += m.dof / 200.0;
    }
    std::printf("%d alarms at 5 %%, %d at 1 %%, drop %.2f for %.2f\n", at_5, at_1, drop, dof);
    EXPECT_LE(at_5, 21);
    EXPECT_GE(at_5, 2);
    EXPECT_LE(at_1, 8);
    EXPECT_GE(dof, 3.0);
    // A chi-square's mean is its dof, its variance twice that.
    EXPECT_NEAR(drop, dof, 4.0 * std::sqrt(2.0 * dof / 200.0) + 0.05 * dof);
  }
}

// Half of one dipole and half of another, at the three noise levels.
TEST(DipoleMisfit, TwoDipolesAreNotOne) {
  const Eigen::VectorXd l = 0.5 * plate().plate.image(Dipole({6.0, 0.05, 1.4})) +
                            0.5 * plate().plate.image(Dipole({0.5, 0.002, 1.4}));
  for (double noise : {0.001, 0.01, 0.1}) {
    for (unsigned seed = 1; seed <= 10; ++seed) {
      const DipoleMisfit m = misfit(noisy_system(plate().w, l, noise, seed), {0.02});
      EXPECT_LT(m.p_value, 1e-6) << noise;
      EXPECT_GT(m.log_departure, 0.1);
    }
  }
}

// An error of the method's own that is declared (here one that looks like 10 % more light between
// 1 and 9 mm) must not be taken for the material's, and is where it is not declared.
TEST(DipoleMisfit, ForgivesWhatANuisanceExplains) {
  const Dipole dipole({1.2, 0.004, 1.4});
  Eigen::VectorXd more(plate().knots.size());
  for (Eigen::Index i = 0; i < more.size(); ++i) {
    const double d = plate().knots.knots_mm()[static_cast<std::size_t>(i)];
    more[i] = 0.1 * dipole.reflectance_per_mm2(d) *
              std::exp(-std::pow(std::log(std::max(d, 1e-9) / 3.0), 2));
  }
  const Eigen::VectorXd shape = plate().w * more;
  DenseSystem system = noisy_system(plate().w, plate().plate.image(dipole) + shape, 0.001, 4);
  EXPECT_LT(misfit(system, {0.02}).p_value, 1e-6);
  system.nuisances = {{"method", 1.0, false}};
  system.nuisance_columns = shape;
  EXPECT_GT(misfit(system, {0.02}).p_value, 1e-3);
}

TEST(DipoleMisfit, SaysWhyItCannotTell) {
  const Eigen::VectorXd l = plate().plate.image(Dipole({1.2, 0.004, 1.4}));
  const RecoveredReflectance dark = recover_reflectance(noisy_system(0.0 * plate().w, l, 0.01, 1));
  EXPECT_FALSE(dipole_misfit(dark, {}, plate().knots, {1.0, 0.01, 1.3}, 1.0).reasons.empty());
  const RecoveredReflectance few =
      recover_reflectance(noisy_system(plate().w.topRows(2), l.head(2), 0.3, 1));
  EXPECT_FALSE(dipole_misfit(few, {}, plate().knots, {1.0, 0.01, 1.3}, 1.0).reasons.empty());
  EXPECT_FALSE(dipole_misfit(few, {}, plate().knots, {0.0, 0.01, 1.3}, 1.0).reasons.empty());
  DipoleMisfitOptions bad;
  bad.sought_departure = 0.0;
  EXPECT_THROW(dipole_misfit(few, {}, plate().knots, {1.0, 0.01, 1.3}, 1.0, bad),
               std::invalid_argument);
}

}  // namespace
}  // namespace scattermeter
