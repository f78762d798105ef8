#include "core/fit/dipole_fit.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/core/free_scale.h"
#include "tests/fixtures/core/half_lit_plate.h"

namespace scattermeter {
namespace {

using test_support::HalfLitPlate;
using test_support::kFree;
using test_support::noisy_system;
using ::testing::HasSubstr;

// Truth by quadrature, noise-free, exact scale; the patch is up to 2.2 mean free paths long.
TEST(DipoleFit, RecoversTheTruthWhateverThePatch) {
  const Medium truth{2.19, 0.002, 1.3};
  for (double patch_mm : {0.5, 1.0}) {
    const HalfLitPlate plate(patch_mm);
    const DistanceKnots knots = plate.knots();
    const WeightMatrix w = plate.weights(knots);
    DipoleFitOptions options;
    options.eta_int_over_ext = truth.eta_int_over_ext;
    const Estimate e =
        fit_dipole(noisy_system(w, plate.image(Dipole(truth)), 0.0, 1), knots, options).estimate;
    EXPECT_TRUE(e.converged);
    EXPECT_NEAR(e.sigma_s_prime_per_mm.value, 2.19, 0.002 * 2.19) << "patch " << patch_mm;
    EXPECT_NEAR(e.sigma_a_per_mm.value, 0.002, 0.01 * 0.002) << "patch " << patch_mm;
    EXPECT_TRUE(e.reasons.empty()) << e.reasons.front();
  }
}

// Over noise seeds: unbiased, and the predicted deviations are the sampled ones. With 60 seeds the
// sampled deviation itself is uncertain by 9 %; 30 % is more than three of that.
class DipoleFitNoise : public ::testing::TestWithParam<double> {};

TEST_P(DipoleFitNoise, UncertaintyIsTrue) {
  const double scale_std = GetParam();
  const Medium truth{1.2, 0.004, 1.4};
  const HalfLitPlate plate(1.0);
  const DistanceKnots knots = plate.knots();
  const WeightMatrix w = plate.weights(knots);
  const Eigen::VectorXd l = plate.image(Dipole(truth));
  DipoleFitOptions options;
  options.eta_int_over_ext = truth.eta_int_over_ext;
  options.scale.relative_std = scale_std;
  constexpr int kSeeds = 60;
  Eigen::ArrayXd s(kSeeds), a(kSeeds), scale(kSeeds), predicted_s(kSeeds), predicted_a(kSeeds);
  std::mt19937 random(99);
  std::normal_distribution<double> normal;
  for (int i = 0; i < kSeeds; ++i) {
    // A prior is a statement about how the scale is drawn.
    scale[i] = std::isfinite(scale_std) ? std::exp(scale_std * normal(random)) : 37.0;
    const Estimate e = fit_dipole(noisy_system(w, scale[i] * l, 0.01, static_cast<unsigned>(i + 1)),
                                  knots, options)
                           .estimate;
    ASSERT_TRUE(e.converged);
    s[i] = e.sigma_s_prime_per_mm.value;
    a[i] = e.sigma_a_per_mm.value;
    predicted_s[i] = e.sigma_s_prime_per_mm.std;
    predicted_a[i] = e.sigma_a_per_mm.std;
    EXPECT_NEAR(e.reduced_chi2, 1.0, 0.3);
    EXPECT_NEAR(e.scale.value / scale[i], 1.0, 5.0 * e.scale.std / scale[i] + 1e-12);
  }
  const auto sampled = [](const Eigen::ArrayXd& v) {
    return std::sqrt((v - v.mean()).square().sum() / (kSeeds - 1));
  };
  EXPECT_NEAR(sampled(s) / predicted_s.mean(), 1.0, 0.3);
  EXPECT_NEAR(sampled(a) / predicted_a.mean(), 1.0, 0.3);
  // Mean within four of its own deviations, plus the 0.2 % and 1 % of the discretisation.
  EXPECT_NEAR(s.mean(), 1.2, 4.0 * sampled(s) / std::sqrt(kSeeds) + 0.002 * 1.2);
  EXPECT_NEAR(a.mean(), 0.004, 4.0 * sampled(a) / std::sqrt(kSeeds) + 0.01 * 0.004);
}

// An image without its noise states what images with it state on average, also where the model
// misses part of it from row to row.
TEST(DipoleFit, WithoutNoiseStatesWhatNoiseWould) {
  const Medium truth{1.2, 0.004, 1.4};
  const HalfLitPlate plate(1.0);
  const DistanceKnots knots = plate.knots();
  const WeightMatrix w = plate.weights(knots);
  DipoleFitOptions options;
  options.eta_int_over_ext = truth.eta_int_over_ext;
  Eigen::VectorXd l = plate.image(Dipole(truth));
  for (Eigen::Index j = 0; j < l.size(); ++j) l[j] *= j % 2 == 0 ? 1.01 : 0.99;
  constexpr int kSeeds = 30;
  double chi2 = 0.0;
  double std_s = 0.0;
  double std_a = 0.0;
  for (int i = 0; i < kSeeds; ++i) {
    const Estimate e =
        fit_dipole(noisy_system(w, l, 0.01, static_cast<unsigned>(i + 1)), knots, options).estimate;
    chi2 += e.reduced_chi2 / kSeeds;
    std_s += e.sigma_s_prime_per_mm.std / kSeeds;
    std_a += e.sigma_a_per_mm.std / kSeeds;
  }
  EXPECT_NEAR(chi2, 2.0, 0.2);
  DenseSystem expected = noisy_system(w, l, 0.01, 1);
  expected.l = l;
  options.without_noise = true;
  const Estimate e = fit_dipole(expected, knots, options).estimate;
  EXPECT_NEAR(e.reduced_chi2 / chi2, 1.0, 0.05);
  EXPECT_NEAR(e.sigma_s_prime_per_mm.std / std_s, 1.0, 0.1);
  EXPECT_NEAR(e.sigma_a_per_mm.std / std_a, 1.0, 0.1);
}

INSTANTIATE_TEST_SUITE_P(Scales, DipoleFitNoise, ::testing::Values(0.0, 0.02, kFree));

// The same object a thousand times larger is the same fit.
TEST(DipoleFit, ScalesWithTheWorld) {
  const HalfLitPlate plate(1.0);
  const DistanceKnots knots = plate.knots();
  const WeightMatrix w = plate.weights(knots);
  const Eigen::VectorXd l = plate.image(Dipole({1.2, 0.004, 1.3}));
  DipoleFitOptions options;
  const Estimate small = fit_dipole(noisy_system(w, l, 0.01, 3), knots, options).estimate;
  // Areas grow by 10^6 and R falls by 10^6: l stays, W grows.
  const DistanceKnots large_knots(1000.0 * knots.resolution_mm(), 1000.0 * knots.max_distance_mm());
  DenseSystem system = noisy_system(w, l, 0.01, 3);
  // The octaves of the large world start at another power of two: bin afresh by interpolation-free
  // comparison is impossible, so the fit is compared within the knots' own accuracy.
  PairSumOptions pairs;
  pairs.floor_mm = large_knots.resolution_mm();
  IncidentLight light = plate.light();
  for (LitTriangle& t : light.lit) {
    for (auto& c : t.corners_mm) c *= 1000.0;
  }
  std::vector<ExitSite> sites = plate.sites();
  for (ExitSite& site : sites) {
    site.center_mm *= 1000.0;
    site.covariance_mm2 *= 1e6;
    for (auto& p : site.points_mm) p *= 1000.0;
    for (auto& p : site.few_mm) p *= 1000.0;
  }
  system.weights = smooth_weights(sites, SourceCloud(light, {0, 0, 0}), large_knots, pairs);
  const Estimate large = fit_dipole(system, large_knots, options).estimate;
  EXPECT_NEAR(1000.0 * large.sigma_s_prime_per_mm.value / small.sigma_s_prime_per_mm.value, 1.0,
              1e-4);
  EXPECT_NEAR(1000.0 * large.sigma_a_per_mm.value / small.sigma_a_per_mm.value, 1.0, 1e-3);
}

TEST(DipoleFit, NoAbsorptionIsFoundAsNone) {
  const HalfLitPlate plate(1.0);
  const DistanceKnots knots = plate.knots();
  const DenseSystem system =
      noisy_system(plate.weights(knots), plate.image(Dipole({1.5, 0.0, 1.3})), 0.0, 1);
  const Estimate e = fit_dipole(system, knots, {}).estimate;
  EXPECT_TRUE(e.converged);
  EXPECT_NEAR(e.sigma_a_per_mm.value, 0.0, 2e-5);
  EXPECT_GE(e.sigma_a_per_mm.low95, 0.0);
  EXPECT_NEAR(e.sigma_s_prime_per_mm.value, 1.5, 0.003 * 1.5);
}

std::string reasons(const Estimate& e) {
  std::string all;
  for (const std::string& r : e.reasons) all += r + "; ";
  return all;
}

// sigma_a of a third of its deviation and more: the deviation reaches as far up as the interval,
// and the budget adds up to it.
TEST(DipoleFit, DeviationOfALittleAbsorptionIsThatTowardsMore) {
  const Medium truth{1.2, 0.0005, 1.4};
  const HalfLitPlate plate(1.0);
  const DistanceKnots knots = plate.knots();
  const WeightMatrix w = plate.weights(knots);
  const Eigen::VectorXd l = plate.image(Dipole(truth));
  DipoleFitOptions options;
  options.eta_int_over_ext = truth.eta_int_over_ext;
  int longer = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const Estimate e = fit_dipole(noisy_system(w, l, 0.3, seed), knots, options).estimate;
    const Quantity& a = e.sigma_a_per_mm;
    if (!(a.std > 0.2 * a.value) || !std::isfinite(a.std)) continue;
    EXPECT_GE(1.96 * a.std, (a.high95 - a.value) * (1.0 - 1e-9)) << seed;
    double square = 0.0;
    for (const BudgetLine& line : e.budget) {
      square += line.std_sigma_a_per_mm * line.std_sigma_a_per_mm;
    }
    EXPECT_NEAR(std::sqrt(square), a.std, 1e-6 * a.std) << seed;
    ++longer;
  }
  EXPECT_GE(longer, 5);
}

TEST(DipoleFit, RefusesWhatItCannotTell) {
  const HalfLitPlate plate(1.0);
  const DistanceKnots knots = plate.knots();
  const WeightMatrix w = plate.weights(knots);
  const Eigen::VectorXd l = plate.image(Dipole({1.2, 0.004, 1.3}));

  DenseSystem few = noisy_system(w.topRows(7), l.head(7), 0.01, 1);
  EXPECT_THAT(reasons(fit_dipole(few, knots, {}).estimate), HasSubstr("only 7 patches"));

  const DenseSystem dark = noisy_system(0.0 * w, l, 0.01, 1);
  EXPECT_THAT(reasons(fit_dipole(dark, knots, {}).estimate), HasSubstr("no light"));

  // Light that no dipole makes: brighter on the dark side.
  DenseSystem odd = noisy_system(w, l.reverse(), 0.01, 1);
  EXPECT_THAT(reasons(fit_dipole(odd, knots, {}).estimate), HasSubstr("does not explain"));

  // A mean free path a quarter of the finest knot.
  const DenseSystem dense =
      noisy_system(w, plate.image(Dipole({4.0 / knots.resolution_mm(), 0.001, 1.3})), 0.01, 1);
  EXPECT_FALSE(fit_dipole(dense, knots, {}).estimate.reasons.empty());
}

}  // namespace
}  // namespace scattermeter
