#include "core/material/rough_boundary.h"

#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <gtest/gtest.h>

#include "core/material/fresnel.h"
#include "core/material/smooth_boundary.h"
#include "tests/fixtures/draws.h"

namespace scattermeter {
namespace {

const Eigen::Vector3d kUp = Eigen::Vector3d::UnitZ();

Eigen::Vector3d at_angle(double cosine, double around = 0.4) {
  const double s = std::sqrt(1.0 - cosine * cosine);
  return {s * std::cos(around), s * std::sin(around), cosine};
}

// A direction of an even radiance, by its flux through the surface, upwards.
Eigen::Vector3d of_even_light(RandomStream& random) {
  const RandomStream::DiscPoint p = random.disc();
  return {p.x, p.y, std::sqrt(1.0 - p.r2)};
}

TEST(RoughBoundary, RefusesWhatItDoesNotKnow) {
  EXPECT_THROW(RoughBoundary(0.0, 1.4), std::invalid_argument);
  EXPECT_THROW(RoughBoundary(0.51, 1.4), std::invalid_argument);
  EXPECT_THROW(RoughBoundary(0.2, 0.9), std::invalid_argument);
}

// In an oven of radiance 1 outside and eta^2 inside, each side's light stays even: what leaves the
// surface is 1 outwards and eta^2 inwards in every direction. The flux is then uniform over the
// square of the cosine. It would not be with another shadowing towards one side, or another eta.
void expect_even(double alpha, double eta, int n, double within) {
  constexpr int kBins = 8;
  const RoughBoundary boundary(alpha, eta);
  RandomStream random(7, static_cast<std::uint64_t>(1000.0 * alpha + 10.0 * eta));
  std::array<std::array<double, kBins>, 2> sum{};
  for (int i = 0; i < n; ++i) {
    for (int inside = 0; inside < 2; ++inside) {
      const Eigen::Vector3d up = of_even_light(random);
      const auto met = boundary.meet(inside == 1 ? up : Eigen::Vector3d(-up), kUp, random);
      EXPECT_NEAR(met.direction.norm(), 1.0, 1e-12);
      const double z = met.direction.z();
      EXPECT_EQ(z > 0.0, (inside == 1) == met.passed);
      const auto bin = static_cast<std::size_t>(std::min(kBins - 1.0, kBins * z * z));
      sum[z > 0.0 ? 0 : 1][bin] += (inside == 1 ? eta * eta : 1.0) / n;
    }
  }
  const double weight = eta * eta;
  for (std::size_t side = 0; side < 2; ++side) {
    const double expected = side == 0 ? 1.0 : weight;
    double all = 0.0;
    for (const double s : sum[side]) {
      // At most as the scatter of independent counts of the heavier weight.
      const double std = std::sqrt(weight * expected / kBins / n);
      EXPECT_NEAR(s, expected / kBins, 4.5 * std) << alpha << " " << eta << " side " << side;
      all += s;
    }
    EXPECT_NEAR(all / expected, 1.0, within) << alpha << " " << eta << " side " << side;
  }
}

TEST(RoughBoundary, AnOvenStaysEven) {
  for (const double alpha : {0.02, 0.1, 0.3, 0.5}) expect_even(alpha, 1.5, 400'000, 4e-3);
}

TEST(RoughBoundaryStatistics, AnOvenStaysEvenToATenthOfAPerCent) {
  const int n = test_support::draws(400'000, 20'000'000);
  for (const double eta : {1.0, 1.3, 1.6}) {
    for (const double alpha : {0.05, 0.1, 0.2, 0.3, 0.5}) {
      expect_even(alpha, eta, n, test_support::long_run() ? 1e-3 : 4e-3);
    }
  }
}

// Flux of even light from one side, counted where it comes from and where it goes by, is that of
// the opposite way: eta_i^2 f(i -> o) = eta_o^2 f(o -> i), for any number of facets.
TEST(RoughBoundary, IsReciprocal) {
  constexpr int kN = 1'000'000;
  constexpr double kRoughEta = 1.4;
  for (const double alpha : {0.1, 0.5}) {
    const RoughBoundary boundary(alpha, kRoughEta);
    RandomStream random(3, 1);
    // In by steep or flat directions outside, to steep or flat ones inside; and out.
    double in[2][2] = {}, out[2][2] = {}, back[2][2] = {};
    const auto flat = [](const Eigen::Vector3d& d) { return d.z() * d.z() < 0.5 ? 1 : 0; };
    for (int i = 0; i < kN; ++i) {
      const Eigen::Vector3d up = of_even_light(random);
      const auto from_outside = boundary.meet(-up, kUp, random);
      (from_outside.passed ? in : back)[flat(up)][flat(from_outside.direction)] += 1.0 / kN;
      const auto from_inside = boundary.meet(up, kUp, random);
      if (from_inside.passed)
        out[flat(from_inside.direction)][flat(up)] += kRoughEta * kRoughEta / kN;
    }
    for (int outside = 0; outside < 2; ++outside) {
      for (int inside = 0; inside < 2; ++inside) {
        const double flux = in[outside][inside];
        EXPECT_NEAR(out[outside][inside], flux, 4.0 * kRoughEta * std::sqrt(2.0 * flux / kN));
      }
    }
    EXPECT_NEAR(back[0][1], back[1][0], 4.0 * std::sqrt(2.0 * back[0][1] / kN));
  }
}

// Towards alpha = 0 the shares are Fresnel's, and directions Snell's.
TEST(RoughBoundary, BecomesSmooth) {
  constexpr int kN = 40'000;
  constexpr double kRoughEta = 1.5;
  const RoughBoundary boundary(1e-4, kRoughEta);
  RandomStream random(5, 1);
  for (const double cosine : {0.2, 0.5, 0.8, 1.0}) {
    for (const bool inside : {false, true}) {
      const Eigen::Vector3d before = at_angle(inside ? cosine : -cosine);
      const Eigen::Vector3d normal = inside ? Eigen::Vector3d(-kUp) : kUp;
      const double eta = inside ? 1.0 / kRoughEta : kRoughEta;
      int passed = 0;
      for (int i = 0; i < kN; ++i) {
        const auto met = boundary.meet(before, kUp, random);
        passed += met.passed ? 1 : 0;
        const Eigen::Vector3d expected =
            met.passed ? refracted(before, normal, eta) : reflected(before, normal);
        if (met.facets == 1) {
          EXPECT_LT((met.direction - expected).norm(), 0.1);
        }
      }
      const double t = fresnel_transmittance(eta, cosine);
      EXPECT_NEAR(passed / static_cast<double>(kN), t, 4.0 * std::sqrt(t * (1.0 - t) / kN) + 1e-3);
    }
    EXPECT_NEAR(boundary.transmittance(cosine), fresnel_transmittance(kRoughEta, cosine), 1e-3);
  }
}

// The closed forms of one facet against the walk: by direction inside, and in all.
TEST(RoughBoundary, OneFacetIsTheWalksFirst) {
  constexpr int kN = 300'000;
  constexpr double kRoughEta = 1.4;
  for (const double alpha : {0.1, 0.3, 0.5}) {
    const RoughBoundary boundary(alpha, kRoughEta);
    RandomStream random(11, 1);
    for (const double cosine : {0.25, 0.7, 1.0}) {
      const Eigen::Vector3d to_viewer = at_angle(cosine);
      constexpr int kBins = 6;
      std::array<double, kBins> walk{}, drawn{}, squares{};
      double passed = 0.0;
      const auto bin = [&](const Eigen::Vector3d& d) {
        return static_cast<std::size_t>(std::min(kBins - 1.0, kBins * (1.0 - d.z() * d.z()) * 2.0));
      };
      for (int i = 0; i < kN; ++i) {
        const auto met = boundary.meet(-to_viewer, kUp, random);
        passed += met.passed ? 1.0 / kN : 0.0;
        if (met.passed && met.facets == 1) walk[bin(met.direction)] += 1.0 / kN;
        const RoughBoundary::Facet facet = boundary.draw_facet(random);
        const auto passage = boundary.pass(to_viewer, kUp, facet);
        if (!passage) continue;
        const double share = boundary.share(to_viewer, facet, *passage);
        drawn[bin(passage->direction)] += share / kN;
        squares[bin(passage->direction)] += share * share / kN;
      }
      for (std::size_t b = 0; b < kBins; ++b) {
        EXPECT_NEAR(drawn[b], walk[b], 4.5 * std::sqrt((walk[b] + squares[b]) / kN) + 1e-5)
            << alpha << " " << cosine << " " << b;
      }
      EXPECT_NEAR(boundary.transmittance(cosine), passed, alpha > 0.4 ? 0.016 : 5e-3)
          << alpha << " " << cosine;
    }
  }
}

// Reflected light: the closed form over the hemisphere against the walk's single facets, and how
// much several of them add.
TEST(RoughBoundary, ReflectsByOneFacetWhatItsDensitySays) {
  constexpr int kN = 400'000;
  constexpr double kRoughEta = 1.4;
  for (const double alpha : {0.1, 0.3, 0.5}) {
    const RoughBoundary boundary(alpha, kRoughEta);
    RandomStream random(13, 1);
    for (const double cosine : {0.4, 0.9}) {
      const Eigen::Vector3d to_light = at_angle(cosine);
      double once = 0.0, more = 0.0, integral = 0.0;
      for (int i = 0; i < kN; ++i) {
        const auto met = boundary.meet(-to_light, kUp, random);
        if (!met.passed) (met.facets == 1 ? once : more) += 1.0 / kN;
      }
      constexpr int kRings = 600;
      for (int i = 0; i < kRings; ++i) {
        for (int j = 0; j < kRings; ++j) {
          const double s = (i + 0.5) / kRings;
          const Eigen::Vector3d to_viewer =
              at_angle(std::sqrt(1.0 - s), 2.0 * std::numbers::pi * (j + 0.5) / kRings);
          integral += std::numbers::pi * boundary.reflection_per_sr(to_light, to_viewer, kUp) /
                      (kRings * kRings);
        }
      }
      EXPECT_NEAR(integral, once, 4.0 * std::sqrt(once / kN) + 5e-5) << alpha << " " << cosine;
      EXPECT_LT(more, (alpha > 0.4 ? 0.2 : 0.1) * once) << alpha << " " << cosine;
      const Eigen::Vector3d to_viewer = at_angle(0.6, 2.0);
      EXPECT_NEAR(boundary.reflection_per_sr(to_light, to_viewer, kUp),
                  boundary.reflection_per_sr(to_viewer, to_light, kUp), 1e-14);
    }
  }
}

}  // namespace
}  // namespace scattermeter
