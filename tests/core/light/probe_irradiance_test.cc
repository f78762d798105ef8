#include "core/light/probe_irradiance.h"

#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "core/light/sky_probe.h"
#include "tests/fixtures/core/boxes.h"
#include "tests/fixtures/core/probes.h"

namespace scattermeter {
namespace {

using Part = ProbeIrradiance::Part;

Eigen::Array3d open(const ProbeTree& tree, double eta, const Eigen::Vector3d& normal) {
  const TransmittedCosine transmitted(eta);
  ProbeIrradiance irradiance(tree, nullptr, transmitted, 1e-4);
  irradiance.set_facet(normal, {});
  return irradiance.open(Part::kSky) + irradiance.open(Part::kBright);
}

Eigen::Vector3d random_direction(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return Eigen::Vector3d(normal(random), normal(random), normal(random)).normalized();
}

// From every projection, any size, any rotation: pi for eta 1, and the integral of cos Ft.
TEST(ProbeIrradiance, EvenProbeHasAClosedForm) {
  std::mt19937 random(1);
  for (const ProbeProjection projection :
       {ProbeProjection::kEquirectangular, ProbeProjection::kAngularMap,
        ProbeProjection::kMirrorBall}) {
    for (const auto& [w, h] : {std::pair{64, 32}, {45, 45}, {300, 200}}) {
      Environment probe = test_support::even_probe(projection, w, h, {1, 2, 0});
      probe.world_from_probe = world_from_probe(random_direction(random), random_direction(random));
      const ProbeTree tree(probe);
      for (const double eta : {1.0, 1.3, 1.5}) {
        const double expected = test_support::even_irradiance(eta);
        if (eta == 1.0) {
          EXPECT_NEAR(expected, std::numbers::pi, 1e-6);
        }
        for (int i = 0; i < 2; ++i) {
          const Eigen::Array3d e = open(tree, eta, random_direction(random));
          EXPECT_NEAR(e[0], expected, 1e-4 * expected) << w << " " << static_cast<int>(projection);
          EXPECT_NEAR(e[1], 2.0 * expected, 2e-4 * expected);
          EXPECT_EQ(e[2], 0.0);
        }
      }
    }
  }
}

// Every pixel in 3 x 3 parts (the brightest in 24 x 24), every part with a ray and the Fresnel
// equations.
Eigen::Array3d brute_force(const ProbeTree& tree, const RayScene* scene, double eta,
                           const Eigen::Vector3d& p, const Eigen::Vector3d& n) {
  const Environment& probe = tree.environment();
  Eigen::Array3d sum = Eigen::Array3d::Zero();
  for (int y = 0; y < probe.height_px; ++y) {
    for (int x = 0; x < probe.width_px; ++x) {
      const float* l = &probe.radiance[3 * static_cast<std::size_t>(y * probe.width_px + x)];
      const Eigen::Array3d radiance(l[0], l[1], l[2]);
      const int parts = radiance.maxCoeff() > 50.0 ? 24 : 3;
      const double sr =
          tree.map().solid_angle_sr({x + 0.0, y + 0.0, x + 1.0, y + 1.0}) / (parts * parts);
      for (int i = 0; i < parts * parts; ++i) {
        const Eigen::Vector3d w =
            probe.world_from_probe *
            tree.map().direction(x + (i % parts + 0.5) / parts, y + (i / parts + 0.5) / parts);
        const double c = n.dot(w);
        if (!(c > 0.0) || (scene != nullptr && scene->occluded_toward(p, n, w))) continue;
        sum += sr * c * fresnel_transmittance(eta, c) * radiance;
      }
    }
  }
  return sum;
}

// A sky with a sun of 1e5, for facets that see it well, at grazing and not at all.
TEST(ProbeIrradiance, OpenSkyEqualsBruteForce) {
  const ProbeTree tree(make_sky_probe());
  ASSERT_FALSE(tree.bright().empty());
  const Eigen::Vector3d sun = SkyProbe().sun_direction.normalized();
  const Eigen::Vector3d across = sun.unitOrthogonal();
  for (const double eta : {1.0, 1.45}) {
    for (const Eigen::Vector3d& n :
         {Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(0.6, -0.48, 0.64), across,
          Eigen::Vector3d((across + 0.004 * sun).normalized()), Eigen::Vector3d(-sun)}) {
      const Eigen::Array3d expected = brute_force(tree, nullptr, eta, {0, 0, 0}, n);
      const Eigen::Array3d got = open(tree, eta, n);
      EXPECT_LT(((got - expected) / expected).abs().maxCoeff(), 1e-4)
          << got.transpose() << " / " << expected.transpose();
    }
  }
}

// Rotating the probe and the surface together changes nothing but rounding and the way the horizon
// cuts the cells; the total over the sphere of a sun pixel does not depend on it.
TEST(ProbeIrradiance, RotationConserves) {
  Environment probe = make_sky_probe();
  const Eigen::Array3d expected = open(ProbeTree(probe), 1.4, {0, 0, 1});
  std::mt19937 random(5);
  for (int i = 0; i < 3; ++i) {
    probe.world_from_probe = world_from_probe(random_direction(random), random_direction(random));
    const ProbeTree tree(probe);
    const Eigen::Array3d got = open(tree, 1.4, probe.world_from_probe * Eigen::Vector3d(0, 0, 1));
    EXPECT_LT(((got - expected) / expected).abs().maxCoeff(), 1e-6);
    // All normals together: each direction is seen with a mean cosine of 1/4 of the sphere's.
    EXPECT_NEAR(tree.bright_flux()[1], ProbeTree(make_sky_probe()).bright_flux()[1], 1e-9);
  }
}

// At random points before a pyramid, seen from a tilted facet as well.
TEST(ProbeIrradiance, BehindAnOccluderEqualsBruteForce) {
  const ProbeTree tree(make_sky_probe());
  const TriangleMesh mesh = test_support::make_pyramid(5.0, 12.0);
  const RayScene scene(mesh);
  const TransmittedCosine transmitted(1.45);
  ProbeIrradiance irradiance(tree, &scene, transmitted, 1e-4);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-12.0, 12.0);
  double squares = 0.0;
  int shaded = 0;
  constexpr int kPoints = 12;
  for (int i = 0; i < kPoints; ++i) {
    Eigen::Vector3d p(uniform(random), uniform(random), 0.0);
    if (p.cwiseAbs().maxCoeff() < 5.5) p.x() += 8.0;
    const Eigen::Vector3d n =
        (Eigen::Vector3d(0, 0, 1) + (i % 3 == 0 ? 0.5 : 0.0) * random_direction(random))
            .normalized();
    std::vector<Eigen::Vector3d> front;
    for (const Eigen::Vector3d& v : mesh.vertices_mm) {
      if (n.dot(v - p) > 1e-6) front.push_back(v);
    }
    irradiance.set_facet(n, front);
    const Eigen::Array3d all = irradiance.open(Part::kSky) + irradiance.open(Part::kBright);
    const Eigen::Array3d got = irradiance.at(p, Part::kSky) + irradiance.at(p, Part::kBright);
    const Eigen::Array3d error = (got - brute_force(tree, &scene, 1.45, p, n)) / all;
    // Three times what the tolerance aims at, at the worst of the points.
    EXPECT_LT(error.abs().maxCoeff(), 3e-4) << p.transpose();
    squares += error.square().mean();
    shaded += ((all - got) / all).maxCoeff() > 0.01 ? 1 : 0;
  }
  EXPECT_LT(std::sqrt(squares / kPoints), 1e-4);
  EXPECT_GT(shaded, kPoints / 2);
}

}  // namespace
}  // namespace scattermeter
