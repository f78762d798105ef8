// The fit at the edges of what can be asked of it: no crash, no number that is not finite under an
// answer that may be trusted, and no wrong answer under it.
#include <cmath>
#include <cstdio>
#include <map>
#include <random>
#include <string>
#include <tuple>

#include <gtest/gtest.h>

#include "tests/fixtures/core/free_scale.h"
#include "tests/fixtures/core/lit_plate.h"
#include "tests/fixtures/core/noisy_system.h"

namespace scattermeter {
namespace {

using test_support::fit_with_method_errors;
using test_support::is_wrong;
using test_support::kFree;
using test_support::LitPlate;
using test_support::noisy_system;
using test_support::Rectangle;

const Medium kStressMedium{1.2, 0.004, 1.3};

struct WeighedPlate {
  LitPlate plate;
  DistanceKnots knots = plate.knots();
  WeightMatrix w = plate.weights(knots);
};

const WeighedPlate& half_lit() {
  static const WeighedPlate p{LitPlate(1.0, {0, 15, -15, 15})};
  return p;
}

const WeighedPlate& evenly_lit() {
  static const WeighedPlate p{LitPlate(1.0)};
  return p;
}

std::string text(const Estimate& e) {
  char out[200];
  std::snprintf(out, sizeof out,
                "sigma_s' %g +- %g (%g .. %g), sigma_a %g +- %g (%g .. %g), misfit %g (p %g)",
                e.sigma_s_prime_per_mm.value, e.sigma_s_prime_per_mm.std,
                e.sigma_s_prime_per_mm.low95, e.sigma_s_prime_per_mm.high95, e.sigma_a_per_mm.value,
                e.sigma_a_per_mm.std, e.sigma_a_per_mm.low95, e.sigma_a_per_mm.high95,
                e.misfit_relative, e.misfit_p_value);
  return out;
}

// Finite and in order, or refused.
void expect_sound(const Estimate& e) {
  if (!e.reasons.empty()) return;
  for (const Quantity& q : {e.sigma_s_prime_per_mm, e.sigma_a_per_mm}) {
    EXPECT_TRUE(std::isfinite(q.value) && std::isfinite(q.std)) << text(e);
    EXPECT_TRUE(std::isfinite(q.low95) && std::isfinite(q.high95)) << text(e);
    EXPECT_GE(q.value, 0.0);
    EXPECT_GT(q.std, 0.0);
    EXPECT_LE(0.0, q.low95);
    EXPECT_LE(q.low95, q.value);
    EXPECT_LT(q.value, q.high95);
  }
  EXPECT_TRUE(std::isfinite(e.correlation) && std::abs(e.correlation) <= 1.0 + 1e-9);
  EXPECT_TRUE(std::isfinite(e.scale.value) && std::isfinite(e.scale.std));
  EXPECT_TRUE(std::isfinite(e.reduced_chi2) && std::isfinite(e.misfit_relative));
}

Estimate fitted(const DenseSystem& system, const DistanceKnots& knots, double scale_std) {
  DipoleFitOptions options;
  options.scale.relative_std = scale_std;
  const Estimate e = fit_with_method_errors(system, knots, 1.0, options).estimate;
  expect_sound(e);
  return e;
}

// Every material, noise and scale prior; images by quadrature. From a third of a patch's width, the
// shortest mean free path that is not refused, to longer than the body.
class EveryMaterial : public ::testing::TestWithParam<std::tuple<bool, double>> {};

TEST_P(EveryMaterial, IsRightOrRefused) {
  const auto [is_half_lit, mfp_mm] = GetParam();
  const WeighedPlate& plate = is_half_lit ? half_lit() : evenly_lit();
  int trusted = 0, cases = 0;
  for (double albedo : {0.3, 0.5, 0.8, 0.95, 0.999, 0.99999, 1.0}) {
    const Medium truth{albedo / mfp_mm, (1.0 - albedo) / mfp_mm, 1.3};
    const Eigen::VectorXd l = plate.plate.image(truth);
    for (double noise : {1e-6, 1e-4, 1e-2, 0.3}) {
      for (double scale_std : {0.0, 0.02, kFree}) {
        const Estimate e = fitted(noisy_system(plate.w, l, noise, 3), plate.knots, scale_std);
        EXPECT_FALSE(is_wrong(e, truth))
            << "mean free path " << mfp_mm << ", albedo " << albedo << ", noise " << noise
            << ", scale " << scale_std << ": " << text(e);
        trusted += e.reasons.empty() ? 1 : 0;
        ++cases;
      }
    }
  }
  std::printf("%d of %d answers are trusted\n", trusted, cases);
  // Not by refusing all (30 % of noise a row rightly is, at a free scale); a mean free path of the
  // body's size is refused.
  EXPECT_GT(trusted, mfp_mm < 15.0 ? cases / 3 : -1);
}

INSTANTIATE_TEST_SUITE_P(Lights, EveryMaterial,
                         ::testing::Combine(::testing::Bool(),
                                            ::testing::Values(0.35, 0.5, 0.7, 1.0, 3.0, 10.0, 20.0,
                                                              40.0)));

// Patches far too coarse are noticed.
TEST(DipoleStress, PatchesTooCoarseAreRefused) {
  for (double albedo : {0.95, 0.999, 1.0}) {
    const Medium truth{albedo / 0.05, (1.0 - albedo) / 0.05, 1.3};
    const Eigen::VectorXd l = half_lit().plate.image(truth);
    for (double scale_std : {0.0, kFree}) {
      EXPECT_FALSE(fitted(noisy_system(half_lit().w, l, 1e-3, 3), half_lit().knots, scale_std)
                       .reasons.empty());
    }
  }
}

// So is light that is absorbed within a patch.
TEST(DipoleStress, LightThatDiesWithinAPatchIsRefused) {
  const Medium truth{0.6, 1.4, 1.3};
  const Estimate e = fitted(noisy_system(half_lit().w, half_lit().plate.image(truth), 1e-4, 3),
                            half_lit().knots, 0.02);
  ASSERT_FALSE(e.reasons.empty());
  EXPECT_NE(e.reasons.front().find("dies off within"), std::string::npos) << e.reasons.front();
}

// A scale that is stated as exact and is off. Half lit, the image knows better.
TEST(DipoleStress, WrongExactScaleIsNotTrusted) {
  const Eigen::VectorXd l = half_lit().plate.image(kStressMedium);
  int refused_right = 0;
  for (double off : {0.0, 0.003, -0.003, 0.01, -0.01, 0.03, -0.03, 0.1, -0.1}) {
    for (unsigned seed = 1; seed <= 5; ++seed) {
      const Estimate e =
          fitted(noisy_system(half_lit().w, (1.0 + off) * l, 1e-3, seed), half_lit().knots, 0.0);
      EXPECT_FALSE(is_wrong(e, kStressMedium)) << "off by " << off << ": " << text(e);
      EXPECT_TRUE(std::abs(off) < 0.03 || !e.reasons.empty()) << off;
      if (off == 0.0 && !e.reasons.empty()) ++refused_right;
    }
  }
  EXPECT_EQ(refused_right, 0);
}

TEST(DipoleStress, WrongEtaOrEdgeIsNotTrusted) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    for (double eta : {1.25, 1.35}) {
      const Eigen::VectorXd l = half_lit().plate.image({1.2, 0.004, eta});
      EXPECT_FALSE(is_wrong(
          fitted(noisy_system(half_lit().w, l, 1e-3, seed), half_lit().knots, 0.0), kStressMedium));
    }
    for (double shift_mm : {-0.3, 0.3}) {
      const Eigen::VectorXd l = half_lit().plate.image(kStressMedium, shift_mm);
      for (double noise : {1e-3, 1e-2}) {
        EXPECT_FALSE(fitted(noisy_system(half_lit().w, l, noise, seed), half_lit().knots, 0.0)
                         .reasons.empty());
      }
    }
  }
}

// A wrong unit of light: six orders of magnitude.
TEST(DipoleStress, ScaleOffByAMillion) {
  const Eigen::VectorXd l = half_lit().plate.image(kStressMedium);
  for (double factor : {1e-6, 1e6}) {
    for (double scale_std : {0.0, 0.02}) {
      EXPECT_FALSE(
          fitted(noisy_system(half_lit().w, factor * l, 1e-3, 1), half_lit().knots, scale_std)
              .reasons.empty());
    }
    const Estimate e =
        fitted(noisy_system(half_lit().w, factor * l, 1e-3, 1), half_lit().knots, kFree);
    EXPECT_TRUE(e.reasons.empty());
    EXPECT_FALSE(is_wrong(e, kStressMedium)) << text(e);
    EXPECT_NEAR(e.scale.value / factor, 1.0, 0.01);
  }
}

// Two squares of the patches' grid. Rows beside them are 1 % off by the patches' own size, which
// shows, and is refused, where noise is less.
TEST(DipoleStress, ASingleLitSpot) {
  const WeighedPlate plate{LitPlate(1.0, {0, 1.875, -1.875, 1.875})};
  double lit_mm2 = 0.0;
  for (const LitTriangle& t : plate.plate.light().lit) lit_mm2 += power_sr(t);
  ASSERT_NEAR(lit_mm2, 2 * 1.875 * 1.875, 1e-9);
  const Eigen::VectorXd l = plate.plate.image(kStressMedium);
  for (double scale_std : {0.0, 0.02, kFree}) {
    for (double noise : {1e-4, 1e-3, 1e-2, 0.1}) {
      const Estimate e = fitted(noisy_system(plate.w, l, noise, 1), plate.knots, scale_std);
      EXPECT_FALSE(is_wrong(e, kStressMedium))
          << noise << ", scale " << scale_std << ": " << text(e);
      EXPECT_TRUE(noise != 1e-2 || e.reasons.empty()) << e.reasons.front();
    }
  }
}

// Rows twice: no row more is told, but rows whose noise is the same are not known to be. Sources
// twice: the light is.
TEST(DipoleStress, Duplicates) {
  const Eigen::VectorXd l = half_lit().plate.image(kStressMedium);
  const DenseSystem one = noisy_system(half_lit().w, l, 1e-2, 1);
  DenseSystem two = one;
  two.weights.resize(2 * one.l.size(), one.weights.cols());
  two.weights << one.weights, one.weights;
  two.l.resize(2 * one.l.size());
  two.l << one.l, one.l;
  two.std_l.resize(2 * one.l.size());
  two.std_l << one.std_l, one.std_l;
  two.std_l *= std::sqrt(2.0);
  const Estimate a = fitted(one, half_lit().knots, 0.0);
  const Estimate b = fitted(two, half_lit().knots, 0.0);
  EXPECT_NEAR(b.sigma_a_per_mm.value / a.sigma_a_per_mm.value, 1.0, 1e-6);
  EXPECT_NEAR(b.sigma_a_per_mm.std / a.sigma_a_per_mm.std, 1.0, 0.05);

  IncidentLight light = half_lit().plate.light();
  light.lit.insert(light.lit.end(), light.lit.begin(), light.lit.end());
  PairSumOptions pairs;
  pairs.floor_mm = half_lit().knots.resolution_mm();
  const WeightMatrix doubled = smooth_weights(
      half_lit().plate.sites(), SourceCloud(light, {0, 0, 0}), half_lit().knots, pairs);
  const Estimate c = fitted(noisy_system(doubled, 2.0 * l, 1e-2, 1), half_lit().knots, 0.0);
  EXPECT_FALSE(is_wrong(c, kStressMedium)) << text(c);
  EXPECT_TRUE(c.reasons.empty());
}

// 1 km from the origin of the world, in double precision, and positions that float rounds.
TEST(DipoleStress, FarFromTheOriginAndRounded) {
  const Eigen::Vector3d far(1e6, -5e5, 2e5);
  std::mt19937 random(4);
  std::normal_distribution<double> normal;
  const Eigen::VectorXd l = half_lit().plate.image(kStressMedium);
  for (double jitter : {0.0, 1e-7}) {
    IncidentLight light = half_lit().plate.light();
    const auto moved_point = [&](const Eigen::Vector3d& p) {
      return Eigen::Vector3d(p + far +
                             15.0 * jitter *
                                 Eigen::Vector3d(normal(random), normal(random), normal(random)));
    };
    for (LitTriangle& t : light.lit) {
      for (auto& c : t.corners_mm) c = moved_point(c);
    }
    std::vector<ExitSite> sites = half_lit().plate.sites();
    for (ExitSite& site : sites) site = moved(site, moved_point({0, 0, 0}));
    PairSumOptions pairs;
    pairs.floor_mm = half_lit().knots.resolution_mm();
    const WeightMatrix w = smooth_weights(sites, SourceCloud(light, far), half_lit().knots, pairs);
    const Eigen::VectorXd r = dipole_curve(half_lit().knots, std::log(1.204), 0.004 / 1.204, 1.3).r;
    EXPECT_LT(((w - half_lit().w) * r).cwiseAbs().maxCoeff(), 1e-5 * l.maxCoeff());
    const Estimate e = fitted(noisy_system(w, l, 1e-3, 1), half_lit().knots, 0.0);
    EXPECT_TRUE(e.reasons.empty());
    EXPECT_FALSE(is_wrong(e, kStressMedium)) << text(e);
  }
}

// From the fewest rows to many.
TEST(DipoleStress, TwentyRows) {
  const Eigen::VectorXd l = half_lit().plate.image(kStressMedium);
  const Eigen::Index step = l.size() / 20;
  WeightMatrix w(20, half_lit().w.cols());
  Eigen::VectorXd few(20);
  for (Eigen::Index i = 0; i < 20; ++i) {
    w.row(i) = half_lit().w.row(i * step);
    few[i] = l[i * step];
  }
  for (double noise : {1e-6, 1e-3, 0.1}) {
    for (double scale_std : {0.0, 0.02, kFree}) {
      for (unsigned seed = 1; seed <= 5; ++seed) {
        const Estimate e = fitted(noisy_system(w, few, noise, seed), half_lit().knots, scale_std);
        EXPECT_FALSE(is_wrong(e, kStressMedium)) << noise << ' ' << scale_std << ": " << text(e);
      }
    }
  }
}

TEST(DipoleStress, AHundredThousandRows) {
  const Eigen::VectorXd l = half_lit().plate.image(kStressMedium);
  const Eigen::Index n = half_lit().w.rows();
  const Eigen::Index times = 100'000 / n + 1;
  DenseSystem s{WeightMatrix(times * n, half_lit().w.cols()), Eigen::VectorXd(times * n),
                Eigen::VectorXd(times * n)};
  for (Eigen::Index i = 0; i < times; ++i) {
    const DenseSystem one = noisy_system(half_lit().w, l, 0.05, static_cast<unsigned>(i + 1));
    s.weights.middleRows(i * n, n) = one.weights;
    s.l.segment(i * n, n) = one.l;
    s.std_l.segment(i * n, n) = one.std_l;
  }
  const Estimate e = fitted(s, half_lit().knots, 0.02);
  EXPECT_TRUE(e.reasons.empty()) << e.reasons.front();
  EXPECT_FALSE(is_wrong(e, kStressMedium)) << text(e);
}

// Images that no light makes.
TEST(DipoleStress, AbsurdImagesAreRefused) {
  const Eigen::VectorXd l = half_lit().plate.image(kStressMedium);
  const std::map<std::string, Eigen::VectorXd> images = {
      {"zero", 0.0 * l},
      {"negative", -l},
      {"even", Eigen::VectorXd::Constant(l.size(), l.mean())},
      {"huge", 1e200 * l},
      {"tiny", 1e-200 * l},
      {"not a number", Eigen::VectorXd::Constant(l.size(), std::nan(""))}};
  for (const auto& [name, image] : images) {
    for (double scale_std : {0.0, 0.02, kFree}) {
      DenseSystem s = noisy_system(half_lit().w, l, 1e-2, 1);
      s.l = image;
      if (name == "huge") s.std_l *= 1e200;
      if (name == "tiny") s.std_l *= 1e-200;
      const Estimate e = fitted(s, half_lit().knots, scale_std);
      // With a free scale, light of any power is as good.
      const bool may_be_right = (name == "huge" || name == "tiny") && scale_std == kFree;
      EXPECT_TRUE(may_be_right || !e.reasons.empty()) << name << ", scale " << scale_std;
      EXPECT_FALSE(may_be_right && is_wrong(e, kStressMedium)) << name << ": " << text(e);
    }
  }
}

}  // namespace
}  // namespace scattermeter
