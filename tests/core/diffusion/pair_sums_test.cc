#include "core/diffusion/pair_sums.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "core/diffusion/distance_weights.h"
#include "core/material/dipole.h"
#include "tests/fixtures/core/boxes.h"

namespace scattermeter {
namespace {

// Light that falls evenly on the part x > edge_mm of the top of a plate, 1 sr/mm^2 behind the
// surface.
IncidentLight half_lit_top(const PatchMesh& patches, double edge_mm) {
  IncidentLight light;
  for (int k = 0; k < patches.size(); ++k) {
    if (patches.normal(k).z() < 0.5 || patches.center_mm(k).x() < edge_mm) continue;
    light.lit.push_back({patches.corners_mm(k), {1.0, 1.0, 1.0}, k});
  }
  return light;
}

// The same by one-dimensional quadrature in polar coordinates about a point at distance x inside
// the edge (x < 0: outside): ∫ R(rho) rho phi(rho) d rho, where phi is the lit angle at radius rho.
double half_plane(const Dipole& dipole, double x, double rho_max) {
  const int n = 400'000;
  double sum = 0.0;
  for (int i = 0; i < n; ++i) {
    // rho = exp-spaced for the peak at the origin.
    const double a = std::log(1e-6);
    const double b = std::log(rho_max);
    const double rho = std::exp(a + (i + 0.5) / n * (b - a));
    double phi = x > 0 ? 2.0 * std::numbers::pi : 0.0;
    if (rho > std::abs(x)) {
      const double cut = 2.0 * std::acos(std::abs(x) / rho);
      phi += x > 0 ? -cut : cut;
    }
    sum += dipole.reflectance_per_mm2(rho) * rho * rho * phi * (b - a) / n;
  }
  return sum;
}

struct PairCase {
  double patch_mm;
  double z_r_mm;
};

class PairSums : public ::testing::TestWithParam<PairCase> {};

// A plate, lit on one side of a straight edge; sites across the edge. The truth is a quadrature
// that shares nothing with the patches. z_r from a fifth of the patch to five patches.
TEST_P(PairSums, AgreeWithPolarQuadratureAcrossAShadowEdge) {
  const PairCase c = GetParam();
  const double sigma_t = 1.0 / c.z_r_mm;
  // sigma_tr = 10 per 20 mm: the plate's far border holds less than exp(-10) of the light.
  const double sigma_a = 0.25 / (3.0 * sigma_t);
  const Dipole dipole({sigma_t - sigma_a, sigma_a, 1.3});
  const PatchMesh patches(test_support::make_box({-24, -24, -2}, {24, 24, 0}), c.patch_mm);
  const SourceCloud sources(half_lit_top(patches, 0.0), {0, 0, 0});
  const DistanceKnots knots(c.z_r_mm, 70.0);
  std::vector<ExitSite> sites;
  std::vector<double> x;
  for (double at : {-2.0, -0.3, -0.02, 0.0, 0.02, 0.3, 2.0, 3.1}) {
    sites.push_back(exit_point({at, 0.123, 0.0}));
    x.push_back(at);
  }
  PairSumOptions options;
  options.floor_mm = c.z_r_mm / 8;
  const WeightMatrix w = smooth_weights(sites, sources, knots, options);
  Eigen::VectorXd r(knots.size());
  for (int i = 0; i < knots.size(); ++i) {
    r[i] = dipole.reflectance_per_mm2(knots.knots_mm()[static_cast<std::size_t>(i)]);
  }
  const Eigen::VectorXd l = w * r;
  const double total = dipole.total_reflectance();
  // Measured: at most 1.2e-5, but 2.3e-5 for z_r 2 mm, where the plate's corners beyond 24 mm
  // still hold some light.
  for (std::size_t j = 0; j < sites.size(); ++j) {
    EXPECT_NEAR(l[static_cast<Eigen::Index>(j)], half_plane(dipole, x[j], 24.0), 3e-5 * total)
        << "x = " << x[j];
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, PairSums,
                         ::testing::Values(PairCase{0.5, 0.1}, PairCase{0.5, 0.46},
                                           PairCase{0.5, 2.0}, PairCase{0.25, 0.46},
                                           PairCase{1.0, 0.46}));

// ∫ R E dA over a lit triangle from a point, E straight from the LED: cut to an eighth of the
// distance, seven-point rule of degree 5 at the leaves.
double adaptive(const std::array<Eigen::Vector3d, 3>& t, const Eigen::Vector3d& x, const Led& led,
                const Dipole& dipole) {
  const Eigen::Vector3d c = (t[0] + t[1] + t[2]) / 3.0;
  const double edge = std::max({(t[1] - t[0]).norm(), (t[2] - t[1]).norm(), (t[0] - t[2]).norm()});
  if (edge > 0.006 && (edge > (c - x).norm() / 5.0 || edge > 1.5)) {
    const std::array<Eigen::Vector3d, 3> m = {0.5 * (t[1] + t[2]), 0.5 * (t[2] + t[0]),
                                              0.5 * (t[0] + t[1])};
    return adaptive({t[0], m[2], m[1]}, x, led, dipole) +
           adaptive({t[1], m[0], m[2]}, x, led, dipole) +
           adaptive({t[2], m[1], m[0]}, x, led, dipole) + adaptive(m, x, led, dipole);
  }
  const Eigen::Vector3d area = 0.5 * (t[1] - t[0]).cross(t[2] - t[0]);
  const Eigen::Vector3d n = area.normalized();
  const auto f = [&](const Eigen::Vector3d& p) {
    return dipole.reflectance_per_mm2((p - x).norm()) *
           led.transmitted_irradiance_per_mm2(p, n, 1.49);
  };
  double sum = 0.225 * f(c);
  for (const auto& [a, w] : {std::pair{0.059715871789770, 0.132394152788506},
                             std::pair{0.797426985353087, 0.125939180544827}}) {
    for (const Eigen::Vector3d& corner : t)
      sum += w * f(a * corner + 0.5 * (1 - a) * (3 * c - corner));
  }
  return sum * area.norm();
}

// The whole forward model of a cube under an LED against quadrature that shares no discretisation
// with it: mean error (what biases an estimate) and rms.
TEST(PairSumsForward, CubeUnderAnLedMeetsAdaptiveQuadrature) {
  const TriangleMesh mesh = test_support::make_cube();
  const RayScene scene(mesh);
  Led led;
  led.position_mm = {30, -60, 80};
  led.axis = Eigen::Vector3d(-30, 60, -70).normalized();
  for (const PairCase c : {PairCase{0.5, 0.46}, PairCase{1.0, 1.6}}) {
    const Dipole dipole({1.0 / c.z_r_mm - 0.002, 0.002, 1.49});
    const PatchMesh patches(mesh, c.patch_mm);
    const SourceCloud sources(illuminate(patches, scene, led, 1.49), {0, 0, 10});
    const DistanceKnots knots(c.patch_mm / 16, 36.0);
    std::vector<ExitSite> sites;
    for (int k = 0; k < patches.size() && sites.size() < 24; k += patches.size() / 61) {
      const Eigen::Vector3d n = patches.normal(k);
      if (n.z() > 0.5 || n.y() < -0.5 || n.x() > 0.5) sites.push_back(exit_patch(patches, k));
    }
    ASSERT_GE(sites.size(), 20U);
    PairSumOptions options;
    options.floor_mm = knots.resolution_mm();
    Eigen::VectorXd r(knots.size());
    for (int i = 0; i < knots.size(); ++i) {
      r[i] = dipole.reflectance_per_mm2(knots.knots_mm()[static_cast<std::size_t>(i)]);
    }
    const Eigen::VectorXd l = smooth_weights(sites, sources, knots, options) * r;
    Eigen::VectorXd error(l.size());
    for (std::size_t j = 0; j < sites.size(); ++j) {
      double truth = 0.0;
      for (const auto& v : mesh.triangles) {
        const std::array<Eigen::Vector3d, 3> t = {mesh.vertices_mm[static_cast<std::size_t>(v[0])],
                                                  mesh.vertices_mm[static_cast<std::size_t>(v[1])],
                                                  mesh.vertices_mm[static_cast<std::size_t>(v[2])]};
        if ((t[1] - t[0]).cross(t[2] - t[0]).dot(led.position_mm - t[0]) <= 0.0) continue;
        for (std::size_t i = 0; i < static_cast<std::size_t>(sites[j].n_points); ++i) {
          truth += sites[j].weights[i] * adaptive(t, sites[j].points_mm[i], led, dipole);
        }
      }
      error[static_cast<Eigen::Index>(j)] = l[static_cast<Eigen::Index>(j)] / truth - 1.0;
    }
    // Measured: mean at most 8e-6, rms at most 4e-5.
    EXPECT_LT(std::abs(error.mean()), 2e-5) << c.patch_mm;
    EXPECT_LT(std::sqrt(error.squaredNorm() / static_cast<double>(error.size())), 8e-5);
  }
}

// A patch as site is the mean of point sites spread evenly over it.
TEST(PairSumsSite, PatchIsTheMeanOfItsPoints) {
  const Dipole dipole({2.0, 0.01, 1.3});
  const PatchMesh patches(test_support::make_cube(), 0.7);
  const SourceCloud sources(half_lit_top(patches, 0.0), {0, 0, 10});
  const DistanceKnots knots(0.05, 40.0);
  PairSumOptions options;
  options.floor_mm = 0.05;
  Eigen::VectorXd r(knots.size());
  for (int i = 0; i < knots.size(); ++i) {
    r[i] = dipole.reflectance_per_mm2(knots.knots_mm()[static_cast<std::size_t>(i)]);
  }
  int tested = 0;
  for (int k = 0; k < patches.size() && tested < 8; ++k) {
    // On the shadow edge, where the field bends most.
    if (patches.normal(k).z() < 0.5 || std::abs(patches.center_mm(k).x()) > 0.5) continue;
    ++tested;
    const auto c = patches.corners_mm(k);
    std::vector<ExitSite> sites = {exit_patch(patches, k)};
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform;
    constexpr int kPoints = 4000;
    for (int i = 0; i < kPoints; ++i) {
      double u = uniform(random), v = uniform(random);
      if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
      sites.push_back(exit_point(c[0] + u * (c[1] - c[0]) + v * (c[2] - c[0])));
    }
    const Eigen::VectorXd l = smooth_weights(sites, sources, knots, options) * r;
    const double mean = l.tail(kPoints).mean();
    const double spread = std::sqrt((l.tail(kPoints).array() - mean).square().mean() / kPoints);
    // The six-point rule is of degree 4; measured at a bend of width z_r: below 1e-4.
    EXPECT_NEAR(l[0], mean, 4.0 * spread + 1e-4 * dipole.total_reflectance());
  }
  EXPECT_EQ(tested, 8);
}

// A body that is turned, by however little, shows the same image: faces that are nearly
// perpendicular to an axis have covariances whose smallest entries are rounding errors.
TEST(PairSumsSite, ATurnedBodyShowsTheSameImage) {
  const Dipole dipole({2.0, 0.01, 1.3});
  const DistanceKnots knots(0.05, 40.0);
  Eigen::VectorXd r(knots.size());
  for (int i = 0; i < knots.size(); ++i) {
    r[i] = dipole.reflectance_per_mm2(knots.knots_mm()[static_cast<std::size_t>(i)]);
  }
  const auto image = [&](const Eigen::Quaterniond& turn) {
    TriangleMesh mesh = test_support::make_cube();
    const PatchMesh upright(mesh, 0.7);
    for (Eigen::Vector3d& v : mesh.vertices_mm) v = turn * v;
    IncidentLight light = half_lit_top(upright, 3.0);
    for (LitTriangle& t : light.lit) {
      for (Eigen::Vector3d& v : t.corners_mm) v = turn * v;
    }
    const SourceCloud sources(light, turn * Eigen::Vector3d(0, 0, 10));
    std::vector<ExitSite> sites;
    for (int k = 0; k < upright.size(); k += 7) {
      sites.push_back(exit_point(turn * upright.center_mm(k)));
    }
    return Eigen::VectorXd(smooth_weights(sites, sources, knots, {}) * r);
  };
  const Eigen::VectorXd expected = image(Eigen::Quaterniond::Identity());
  for (const Eigen::Vector3d& about : std::vector<Eigen::Vector3d>{
           Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ()}) {
    for (const double from : {0.0, 0.5 * std::numbers::pi}) {
      for (const double by : {1e-8, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2}) {
        const Eigen::Vector3d tilt = Eigen::Vector3d(0.8, 0.5, 0.3).normalized();
        const Eigen::VectorXd l = image(Eigen::Quaterniond(Eigen::AngleAxisd(by, tilt)) *
                                        Eigen::Quaterniond(Eigen::AngleAxisd(from, about)));
        EXPECT_LT((l - expected).norm(), 1e-3 * expected.norm())
            << about.transpose() << ", " << from << ", " << by;
      }
    }
  }
}

// The power binned is the power that entered, whatever the distances and the bins.
TEST(PairSumsSite, ConservesPower) {
  const PatchMesh patches(test_support::make_cube(), 1.0);
  const IncidentLight light = half_lit_top(patches, 3.0);
  double power = 0.0;
  for (const LitTriangle& t : light.lit) power += patches.area_mm2(t.patch_idx);
  const SourceCloud sources(light, {0, 0, 10});
  const UniformBins uniform(0.3, 40.0);
  std::vector<double> sums(static_cast<std::size_t>(uniform.size()));
  add_pair_sums(sources, std::vector{exit_patch(patches, 11)}, uniform, {}, sums.data());
  double total = 0.0;
  for (double s : sums) total += s;
  EXPECT_NEAR(total, power, 1e-5 * power);
}

}  // namespace
}  // namespace scattermeter
