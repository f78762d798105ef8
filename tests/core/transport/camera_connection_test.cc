#include "core/transport/camera_connection.h"

#include <algorithm>
#include <numbers>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "core/material/fresnel.h"
#include "core/transport/path_blocks.h"
#include "tests/fixtures/core/block_mean.h"
#include "tests/fixtures/core/boxes.h"
#include "tests/fixtures/core/bumps.h"
#include "tests/fixtures/core/spheres.h"

namespace scattermeter {
namespace {

struct FirstScatterings {
  double middle = 0;
  void escape(const PathScore&) {}
  void camera(const PathScore& s) {
    if (s.scatterings != 1 || s.point_mm.z() < -1e-9) return;
    if (std::abs(s.point_mm.x()) < 4.0 && std::abs(s.point_mm.y()) < 4.0) middle += s.weight;
  }
};

// Light scattered once, of an even beam straight down: with E the irradiance behind the surface,
//   l(P) = pi / eta^2 ∫ exp(-sigma_t s) sigma_s p E exp(-sigma_t s cos) ds
//        = pi / eta^2 sigma_s p E / (sigma_t (1 + cos)),
// cos that of the refracted ray from P to the camera; over the middle of the face by a midpoint
// rule.
void expect_single_scattering(const PathBoundary& boundary) {
  const ScatteringMedium medium{1.5, 0.5, 0.4, 1.3};
  const auto source = beam_entry({{-10, -10, 0}, {20, 0, 0}, {0, 20, 0}, {0, 0, -1}});
  for (const Eigen::Vector3d& eye : {Eigen::Vector3d(3, -8, 10), Eigen::Vector3d(0, -800, 400)}) {
    const CameraConnection camera(boundary, eye, medium);
    test_support::BlockMean seen;
    PathOptions options;
    options.paths_per_block = 2000;
    trace_blocks<FirstScatterings>(
        {boundary, medium, *source, &camera}, options, 0, 60, [] { return FirstScatterings(); },
        [&](const FirstScatterings& s, const PathAudit&) { seen.add(s.middle); });
    double expected = 0.0;
    constexpr int kSteps = 200;
    for (int i = 0; i < kSteps; ++i) {
      for (int j = 0; j < kSteps; ++j) {
        const Eigen::Vector3d p(-4.0 + (i + 0.5) * 8.0 / kSteps, -4.0 + (j + 0.5) * 8.0 / kSteps,
                                0);
        const double cos_out = (eye - p).normalized().z();
        const double cosine = std::sqrt(1.0 - (1.0 - cos_out * cos_out) / (1.3 * 1.3));
        expected += std::numbers::pi / (1.3 * 1.3) * 1.5 * HenyeyGreenstein(0.4).per_sr(-cosine) /
                    400.0 / (2.0 * (1.0 + cosine)) * std::pow(8.0 / kSteps, 2);
      }
    }
    EXPECT_LT(std::abs(seen.z(expected)), test_support::kSigmas) << seen.mean() << " " << expected;
    EXPECT_LT(seen.std_error(), 0.015 * expected);
  }
}

TEST(CameraConnection, SeesSingleScatteringAsQuadratureDoes) {
  const RayScene scene(test_support::make_box({-12, -12, -12}, {12, 12, 0}));
  const PathBoundary boundary(scene);
  expect_single_scattering(boundary);
}

// The same box with a bottom of many planes, far below: the connections go through the beams of the
// facets of a top that is cut in 128.
TEST(CameraConnection, SeesSingleScatteringThroughManyFacets) {
  TriangleMesh box = cut_finer(test_support::make_box({-12, -12, -12}, {12, 12, 0}), 3);
  for (Eigen::Vector3d& v : box.vertices_mm) {
    if (v.z() == -12.0) v.z() -= 0.02 * (v.head<2>() - Eigen::Vector2d(1, 2)).squaredNorm();
  }
  const RayScene scene(box);
  const PathBoundary boundary(scene);
  ASSERT_TRUE(boundary.body().planes.empty());
  expect_single_scattering(boundary);
}

// The same through a rough face: l is pi / (eta^2 Ft) times the mean over microfacets of share
// sigma_s p E / (sigma_t (1 + cos)), each with its own cos.
TEST(CameraConnection, SeesSingleScatteringThroughARoughFace) {
  constexpr double kRoughEta = 1.4;
  const RayScene scene(test_support::make_box({-12, -12, -12}, {12, 12, 0}));
  const PathBoundary boundary(scene);
  const Eigen::Vector3d eye(0, -600, 400);
  const auto source = beam_entry({{-10, -10, 0}, {20, 0, 0}, {0, 20, 0}, {0, 0, -1}});
  for (const double alpha : {0.02, 0.3}) {
    const ScatteringMedium medium{1.5, 0.5, 0.4, kRoughEta, alpha};
    const CameraConnection camera(boundary, eye, medium);
    test_support::BlockMean seen;
    PathOptions options;
    options.paths_per_block = 2000;
    trace_blocks<FirstScatterings>(
        {boundary, medium, *source, &camera}, options, 0, 160, [] { return FirstScatterings(); },
        [&](const FirstScatterings& s, const PathAudit&) { seen.add(s.middle); });
    const RoughBoundary rough(alpha, kRoughEta);
    RandomStream random(1, 0);
    double expected = 0.0;
    constexpr int kDraws = 100'000;
    for (int i = 0; i < kDraws; ++i) {
      const Eigen::Vector3d p(-4.0 + 8.0 * random.uniform(), -4.0 + 8.0 * random.uniform(), 0);
      const Eigen::Vector3d to_eye = (eye - p).normalized();
      const RoughBoundary::Facet facet = rough.draw_facet(random);
      const auto passage = rough.pass(to_eye, Eigen::Vector3d::UnitZ(), facet);
      if (!passage) continue;
      const double cosine = passage->cos_inside;
      expected += rough.share(to_eye, facet, *passage) * 64.0 / kDraws * std::numbers::pi /
                  (kRoughEta * kRoughEta * fresnel_transmittance(kRoughEta, to_eye.z())) * 1.5 *
                  HenyeyGreenstein(0.4).per_sr(-cosine) / 400.0 / (2.0 * (1.0 + cosine));
    }
    EXPECT_LT(std::abs(seen.z(expected)), test_support::kSigmas) << seen.mean() << " " << expected;
    EXPECT_LT(seen.std_error(), 0.015 * expected);
  }
}

// Distance along a ray to a facet, from Cramer's rule; negative: none.
double distance_to(const TriangleMesh& mesh, std::size_t facet, const Eigen::Vector3d& from,
                   const Eigen::Vector3d& unit) {
  const auto& t = mesh.triangles[facet];
  const Eigen::Vector3d& a = mesh.vertices_mm[static_cast<std::size_t>(t[0])];
  const Eigen::Vector3d ab = mesh.vertices_mm[static_cast<std::size_t>(t[1])] - a;
  const Eigen::Vector3d ac = mesh.vertices_mm[static_cast<std::size_t>(t[2])] - a;
  const Eigen::Vector3d p = unit.cross(ac);
  const double det = ab.dot(p);
  const Eigen::Vector3d s = from - a;
  const double u = s.dot(p) / det;
  const double v = unit.dot(s.cross(ab)) / det;
  return u >= 0.0 && v >= 0.0 && u + v <= 1.0 ? ac.dot(s.cross(ab)) / det : -1.0;
}
bool between(const TriangleMesh& mesh, const Eigen::Vector3d& from, const Eigen::Vector3d& to,
             double less_mm) {
  const double length_mm = (to - from).norm();
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    const double d = distance_to(mesh, f, from, (to - from) / length_mm);
    if (d > less_mm && d < length_mm - less_mm) return true;
  }
  return false;
}

// What is connected, and with what weight, against all facets one by one and all that may lie
// between. Shallow points, whose roulette is sure.
void expect_as_by_all_facets(const TriangleMesh& mesh, const Eigen::Vector3d& eye, double eta,
                             int least) {
  const RayScene scene(mesh);
  const PathBoundary boundary(scene);
  const ScatteringMedium medium{0.1, 0.01, 0.5, eta};
  const double sure_mm = 0.7 / medium.sigma_t_per_mm();
  const CameraConnection camera(boundary, eye, medium);
  RandomStream random(5, 0);
  int n_scores = 0;
  int doubtful = 0;
  std::vector<PathScore> scores;
  for (int i = 0; i < 3000; ++i) {
    // Beneath a random place.
    const std::size_t under = random.bits() % mesh.triangles.size();
    const auto& t = mesh.triangles[under];
    Eigen::Vector3d x = mesh.vertices_mm[static_cast<std::size_t>(t[0])];
    const double u = random.uniform();
    const double v = (1.0 - u) * random.uniform();
    x += u * (mesh.vertices_mm[static_cast<std::size_t>(t[1])] - x) +
         v * (mesh.vertices_mm[static_cast<std::size_t>(t[2])] - x);
    x -= (0.01 + 2.0 * random.uniform()) * boundary.facet_normal(static_cast<int>(under));
    if (!scene.contains(x)) continue;
    const Eigen::Vector3d before = Eigen::Vector3d(1, 2, -1).normalized();
    camera.connect({x, before, 2.0, 7, 3.0}, random, scores);
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
      const auto found = std::find_if(scores.begin(), scores.end(), [&](const PathScore& s) {
        return s.facet_idx == static_cast<int>(f);
      });
      const Eigen::Vector3d& n = boundary.facet_normal(static_cast<int>(f));
      const Eigen::Vector3d& a = mesh.vertices_mm[static_cast<std::size_t>(mesh.triangles[f][0])];
      const double height_mm = n.dot(eye - a);
      const double depth_mm = n.dot(a - x);
      double expected = 0.0;
      if (height_mm > 0.0 && depth_mm > 0.0) {
        const Eigen::Vector3d foot = eye - height_mm * n;
        const Eigen::Vector3d across = x + depth_mm * n - foot;
        const RefractedRay ray = refracted_ray(height_mm, depth_mm, across.norm(), eta);
        const Eigen::Vector3d p = foot + ray.radius_mm * across.normalized();
        if (ray.length_mm > 2.0 * sure_mm) continue;
        // Places within 0.1 um of a silhouette or an edge may fall either way.
        if (distance_to(mesh, f, p + n, -n) > 0.0 && !between(mesh, x, p, 1e-4) &&
            !between(mesh, eye, p, 1e-4)) {
          const double by_roulette =
              std::min(1.0, std::exp(0.7 - medium.sigma_t_per_mm() * ray.length_mm));
          if (by_roulette < 1.0) continue;
          expected = std::numbers::pi / (eta * eta) * 2.0 *
                     HenyeyGreenstein(0.5).per_sr(before.dot((p - x).normalized())) *
                     std::exp(-medium.sigma_t_per_mm() * ray.length_mm) /
                     (ray.cos_inside * ray.spread);
          ++n_scores;
        } else if (found != scores.end() && ray.length_mm > sure_mm) {
          ADD_FAILURE() << "facet " << f << " is not connected";
        }
      }
      const double weight = found == scores.end() ? 0.0 : found->weight;
      if (std::abs(weight - expected) > 1e-6 * expected) ++doubtful;
      if (found != scores.end() && expected > 0.0) {
        EXPECT_NEAR(weight, expected, 1e-6 * expected);
        EXPECT_EQ(found->scatterings, 7);
        EXPECT_GT(found->length_mm, 3.0);
      }
    }
  }
  EXPECT_GE(n_scores, least);
  EXPECT_LE(doubtful, n_scores / 500);
}

TEST(CameraConnection, ConnectsThroughAllFacetsThatHoldThePoint) {
  for (double eta : {1.0, 1.3}) {
    expect_as_by_all_facets(test_support::make_sphere(10, 3), {0, -100, 150}, eta, 500);
    expect_as_by_all_facets(test_support::make_sphere(10, 2), {0, 13, 4}, eta, 300);
    expect_as_by_all_facets(test_support::make_bumps(10, 0.4, 3), {30, 20, 40}, eta, 300);
  }
}

// The same camera for another medium: the same digits as one built for it.
TEST(CameraConnection, IsSharedByMedia) {
  const RayScene scene(test_support::make_sphere(10, 2));
  const PathBoundary boundary(scene);
  const CameraConnection camera(boundary, {0, 0, 50}, {1.0, 0.1, 0.0, 1.3});
  const ScatteringMedium other{0.3, 0.2, 0.6, 1.3};
  const CameraConnection shared = camera.with(other);
  const CameraConnection own(boundary, {0, 0, 50}, other);
  std::vector<PathScore> a, b;
  RandomStream random_a(1, 1), random_b(1, 1);
  int n = 0;
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d x(0.02 * i, -0.01 * i, 9.0 - 0.01 * i);
    shared.connect({x, {0, 0, 1}, 1.0, 1, 1.0}, random_a, a);
    own.connect({x, {0, 0, 1}, 1.0, 1, 1.0}, random_b, b);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t k = 0; k < a.size(); ++k) EXPECT_EQ(a[k].weight, b[k].weight);
    n += static_cast<int>(a.size());
  }
  EXPECT_GT(n, 50);
  EXPECT_THROW(camera.with({1.0, 0.1, 0.0, 1.4}), std::invalid_argument);
}

}  // namespace
}  // namespace scattermeter
