#include "core/fit/dipole_solver.h"

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "core/diffusion/dipole_curve.h"
#include "tests/fixtures/core/free_scale.h"
#include "tests/fixtures/core/plate_system.h"

namespace scattermeter {
namespace {

using Coefficient = DipoleSolver::Coefficient;
using Point = DipoleSolver::Point;
using test_support::kEta;
using test_support::kFree;
using test_support::noisy_system;
using test_support::plate;

DenseSystem drawn_system(const Medium& truth, double noise, unsigned seed, bool with_nuisance) {
  DenseSystem system = noisy_system(plate().w, plate().image(truth), noise, seed);
  if (!with_nuisance) return system;
  system.nuisances = {{"tilt", 0.05, true}};
  system.nuisance_columns.resize(system.l.size(), 1);
  for (std::size_t j = 0; j < plate().plate.rows().size(); ++j) {
    const auto at = static_cast<Eigen::Index>(j);
    const double x = plate().plate.patches().center_mm(plate().plate.rows()[j]).x();
    system.nuisance_columns(at, 0) = system.l[at] * x / 15.0;
  }
  return system;
}

// A system with its solver and a cost of the test's own.
struct Problem {
  Problem(const Medium& truth, double noise, unsigned seed, double scale_std, bool with_nuisance)
      : system(drawn_system(truth, noise, seed, with_nuisance)), scale{scale_std} {}
  Problem(const Problem&) = delete;
  Problem& operator=(const Problem&) = delete;

  DenseSystem system;
  std::vector<Nuisance> fitted = system.nuisances;
  ScalePrior scale;
  RecoveredReflectance recovered = recover_reflectance(system);
  DipoleSolver solver{recovered, plate().knots, fitted, kEta, scale};

  // Chi-square of the image beyond the free r's, and the priors, from the rows themselves.
  double cost(double sigma_s, double sigma_a, double log_s, const std::vector<double>& v) const {
    const double t = sigma_s + sigma_a;
    Eigen::VectorXd rest =
        system.l - system.weights * (std::exp(log_s) *
                                     dipole_curve(plate().knots, std::log(t), sigma_a / t, kEta).r);
    double priors = 0.0;
    for (std::size_t i = 0; i < v.size(); ++i) {
      rest -= v[i] * system.nuisance_columns.col(static_cast<Eigen::Index>(i));
      priors += std::pow(v[i] / fitted[i].std, 2);
    }
    if (scale.relative_std > 0.0) priors += std::pow(log_s / scale.relative_std, 2);
    return rest.cwiseQuotient(system.std_l).squaredNorm() + priors - recovered.floor_chi2;
  }
  double cost(const Point& p) const {
    return cost(p.sigma_s_prime_per_mm(), p.sigma_a_per_mm(), p.log_s, p.v);
  }
};

// Images that a dipole on the knots makes exactly, over all that the knots resolve: no guess, no
// noise, the truth.
TEST(DipoleSolver, FindsTheExactOptimumOfEveryMaterial) {
  for (double sigma_t : {0.1, 0.5, 2.0, 7.0}) {
    for (double q : {0.0, 1e-5, 1e-3, 0.05, 0.5}) {
      for (double scale_std : {0.0, 0.02, kFree}) {
        const Problem problem({(1.0 - q) * sigma_t, q * sigma_t, kEta}, 0.0, 1, scale_std, false);
        const Point p = problem.solver.best();
        EXPECT_TRUE(p.converged);
        EXPECT_NEAR(p.sigma_t_prime_per_mm() / sigma_t, 1.0, 1e-4) << sigma_t << ' ' << q;
        EXPECT_NEAR(p.q, q, 1e-4 * q + 1e-8) << sigma_t << ' ' << q << ' ' << scale_std;
        EXPECT_NEAR(p.log_s, 0.0, 1e-4) << sigma_t << ' ' << q << ' ' << scale_std;
      }
    }
  }
}

// The reported cost is the image's; every neighbour's is larger; a second search agrees.
TEST(DipoleSolver, BestIsTheMinimumOfTheImagesChiSquare) {
  for (double scale_std : {0.0, 0.02, kFree}) {
    for (bool with_nuisance : {false, true}) {
      const Problem problem({1.2, 0.004, kEta}, 0.01, 7, scale_std, with_nuisance);
      const Point p = problem.solver.best();
      ASSERT_TRUE(p.converged);
      ASSERT_EQ(p.v.size(), with_nuisance ? 1U : 0U);
      EXPECT_NEAR(p.cost, problem.cost(p), 1e-6 * problem.system.l.size());
      for (double h : {-1e-3, 1e-3}) {
        EXPECT_GT(
            problem.cost(p.sigma_s_prime_per_mm() * (1 + h), p.sigma_a_per_mm(), p.log_s, p.v),
            p.cost);
        EXPECT_GT(
            problem.cost(p.sigma_s_prime_per_mm(), p.sigma_a_per_mm() * (1 + 10 * h), p.log_s, p.v),
            p.cost);
        if (scale_std > 0.0) {
          EXPECT_GT(problem.cost(p.sigma_s_prime_per_mm(), p.sigma_a_per_mm(), p.log_s + h, p.v),
                    p.cost);
        }
        if (with_nuisance) {
          EXPECT_GT(
              problem.cost(p.sigma_s_prime_per_mm(), p.sigma_a_per_mm(), p.log_s, {p.v[0] + h}),
              p.cost);
        }
      }
    }
  }
}

TEST(DipoleSolver, HeldAtTheOptimumIsTheOptimum) {
  for (double scale_std : {0.0, 0.02, kFree}) {
    const Problem problem({1.2, 0.004, kEta}, 0.01, 7, scale_std, true);
    const Point best = problem.solver.best();
    Point far = best;  // the way there must not matter
    far.u += 0.3;
    if (scale_std > 0.0) far.log_s += 0.1;
    for (Coefficient held : {Coefficient::kSigmaSPrime, Coefficient::kSigmaA}) {
      const double value =
          held == Coefficient::kSigmaA ? best.sigma_a_per_mm() : best.sigma_s_prime_per_mm();
      for (const Point& from : {best, far}) {
        const auto p = problem.solver.best_with(held, value, from);
        ASSERT_TRUE(p.has_value());
        EXPECT_NEAR(p->cost, best.cost, 1e-5);
        EXPECT_NEAR(p->sigma_s_prime_per_mm(), best.sigma_s_prime_per_mm(), 1e-4);
        EXPECT_NEAR(p->sigma_a_per_mm(), best.sigma_a_per_mm(), 1e-6);
      }
    }
  }
}

// An LED twice as bright as stated, without any medium, is five deviations of its power: nearer to
// the image than a medium under even light that is three deviations off. It is not the answer.
TEST(DipoleSolver, DoesNotTakeTheLightForTheMedium) {
  for (double sigma_t : {0.5, 2.0}) {
    for (double q : {1e-3, 0.02}) {
      const Medium truth{(1.0 - q) * sigma_t, q * sigma_t, kEta};
      for (double even : {-0.15, 0.5, 1.5}) {
        DenseSystem system = noisy_system(plate().w, plate().image(truth), 1e-2, 1);
        const Eigen::VectorXd image = system.l;
        system.nuisances = {{"even light", 0.5, true}, {"power", 0.2, true}};
        system.nuisance_columns.resize(image.size(), 2);
        system.nuisance_columns << Eigen::VectorXd::Constant(image.size(), image.mean()), image;
        system.l += even * system.nuisance_columns.col(0);
        const RecoveredReflectance recovered = recover_reflectance(system);
        const DipoleSolver solver(recovered, plate().knots, system.nuisances, kEta, {0.02});
        const Point p = solver.best(
            Point::of({1.3 * truth.sigma_s_prime_per_mm, 2.0 * truth.sigma_a_per_mm, kEta}, 1.0));
        EXPECT_TRUE(p.converged);
        EXPECT_NEAR(p.sigma_s_prime_per_mm() / truth.sigma_s_prime_per_mm, 1.0, 0.05)
            << sigma_t << ' ' << q << ' ' << even << ' ' << p.cost;
      }
    }
  }
}

// Away from the optimum: the value is held, the rest is a minimum, and the profile's slope is the
// partial derivative by the held value alone (envelope theorem), all by the test's own cost.
TEST(DipoleSolver, ProfileIsTheMinimumOverTheRest) {
  const Problem problem({1.2, 0.004, kEta}, 0.01, 7, 0.02, true);
  const Point best = problem.solver.best();
  for (Coefficient held : {Coefficient::kSigmaSPrime, Coefficient::kSigmaA}) {
    const bool a = held == Coefficient::kSigmaA;
    const double optimum = a ? best.sigma_a_per_mm() : best.sigma_s_prime_per_mm();
    for (double factor : {0.9, 0.97, 1.05, 1.1}) {
      const double value = factor * optimum;
      const auto p = problem.solver.best_with(held, value, best);
      ASSERT_TRUE(p.has_value());
      EXPECT_NEAR(a ? p->sigma_a_per_mm() : p->sigma_s_prime_per_mm(), value, 1e-9 * value);
      EXPECT_GT(p->cost, best.cost);
      EXPECT_NEAR(p->cost, problem.cost(*p), 1e-6 * problem.system.l.size());
      const auto with = [&](double own, double other_factor, double d_log_s, double d_v) {
        const double s = a ? p->sigma_s_prime_per_mm() * other_factor : own;
        const double sigma_a = a ? own : p->sigma_a_per_mm() * other_factor;
        return problem.cost(s, sigma_a, p->log_s + d_log_s, {p->v[0] + d_v});
      };
      for (double h : {-1e-3, 1e-3}) {
        EXPECT_GT(with(value, 1 + (a ? 1 : 10) * h, 0, 0), p->cost);
        EXPECT_GT(with(value, 1, h, 0), p->cost);
        EXPECT_GT(with(value, 1, 0, h), p->cost);
      }
      const double step = 1e-3 * optimum;
      const double partial = (with(value + step, 1, 0, 0) - with(value - step, 1, 0, 0)) / 2;
      const auto above = problem.solver.best_with(held, value + step, *p);
      const auto below = problem.solver.best_with(held, value - step, *p);
      ASSERT_TRUE(above && below);
      EXPECT_NEAR((above->cost - below->cost) / 2, partial, 1e-2 * std::abs(partial)) << factor;
    }
  }
}

// No absorption at the optimum: sigma_s' can be held on either side of it all the same.
TEST(DipoleSolver, HoldsBesideTheBoundOfNoAbsorption) {
  int at_bound = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const Problem problem({1.5, 0.0, kEta}, 0.01, seed, 0.02, false);
    const Point best = problem.solver.best();
    if (best.q > 1e-9) continue;
    ++at_bound;
    for (double factor : {0.98, 0.999, 1.0, 1.001, 1.02}) {
      const double value = factor * best.sigma_s_prime_per_mm();
      const auto p = problem.solver.best_with(Coefficient::kSigmaSPrime, value, best);
      ASSERT_TRUE(p.has_value()) << "seed " << seed << ", factor " << factor;
      EXPECT_NEAR(p->sigma_s_prime_per_mm(), value, 1e-9 * value);
      EXPECT_GE(p->cost, best.cost - 1e-5);
    }
  }
  EXPECT_GE(at_bound, 4);
}

TEST(DipoleSolver, HoldsNothingThatNoMaterialHas) {
  const Problem problem({1.2, 0.004, kEta}, 0.01, 7, 0.0, false);
  const Point best = problem.solver.best();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (double value : {-1e-9, nan}) {
    EXPECT_FALSE(problem.solver.best_with(Coefficient::kSigmaA, value, best));
    EXPECT_FALSE(problem.solver.best_with(Coefficient::kSigmaSPrime, value, best));
  }
  EXPECT_FALSE(problem.solver.best_with(Coefficient::kSigmaSPrime, 0.0, best));
  EXPECT_TRUE(problem.solver.best_with(Coefficient::kSigmaA, 0.0, best));
}

}  // namespace
}  // namespace scattermeter
