#include "core/transport/path_tracer.h"

#include <gtest/gtest.h>

#include "core/transport/path_blocks.h"
#include "tests/fixtures/core/block_mean.h"
#include "tests/fixtures/core/boxes.h"
#include "tests/fixtures/core/spheres.h"

namespace scattermeter {
namespace {

struct Escapes {
  double all = 0, up = 0, perturbed = 0;
  void escape(const PathScore& s) {
    all += s.weight;
    if (s.point_mm.z() > -1e-9) up += s.weight;
    perturbed += s.weight * std::pow(1.1, s.scatterings) * std::exp(-0.15 * s.length_mm);
  }
  void camera(const PathScore&) {}
};

struct Result {
  PathAudit audit;
  test_support::BlockMean up, perturbed;
};

Result run(const TriangleMesh& mesh, const ScatteringMedium& medium, const EntrySource& source,
           int blocks, int paths_per_block,
           PathBoundary::Method method = PathBoundary::Method::kAuto) {
  const RayScene scene(mesh);
  const PathBoundary boundary(scene, method);
  PathOptions options;
  options.paths_per_block = paths_per_block;
  Result out;
  trace_blocks<Escapes>(
      {boundary, medium, source, nullptr}, options, 0, blocks, [] { return Escapes(); },
      [&](const Escapes& s, const PathAudit& audit) {
        EXPECT_NEAR(s.all, audit.escaped, 1e-12);
        EXPECT_NEAR(audit.entered, audit.absorbed + audit.escaped + audit.roulette + audit.lost,
                    1e-9 * audit.entered);
        EXPECT_EQ(audit.lost_paths, 0);
        out.audit += audit;
        out.up.add(s.up);
        out.perturbed.add(s.perturbed);
      });
  return out;
}

// Van de Hulst: slab of n 1, mu_a 10/cm, mu_s 90/cm, g 0.75, 0.02 cm: R 0.09739, T 0.66096.
TEST(PathTracer, MeetsVanDeHulst) {
  const auto source = beam_entry({});
  const Result r = run(test_support::make_box({-10, -10, -0.2}, {10, 10, 0}), {9.0, 1.0, 0.75, 1.0},
                       *source, 100, 2000);
  EXPECT_LT(std::abs(r.up.z(0.09739)), test_support::kSigmas) << r.up.mean();
  EXPECT_LT(r.up.std_error(), 6e-4);
}

// A rough boundary neither takes nor makes power, and a white body lets out all of it.
TEST(PathTracer, LosesNothingAtARoughBoundary) {
  const auto source = beam_entry({{-0.4, -0.4, 1}, {0.8, 0, 0}, {0, 0.8, 0}, {0, 0, -1}});
  for (const double alpha : {0.1, 0.5}) {
    for (const TriangleMesh& mesh :
         {test_support::make_box({-1, -1, -1}, {1, 1, 1}), test_support::make_sphere(1.2, 3)}) {
      const Result white = run(mesh, {2.0, 0.0, 0.3, 1.4, alpha}, *source, 4, 500);
      EXPECT_NEAR(white.audit.escaped, white.audit.entered, 1e-9 * white.audit.entered);
      run(mesh, {2.0, 0.1, 0.3, 1.4, alpha}, *source, 4, 500);
    }
  }
}

// Half-spaces are boxes of 200 mean free paths and more. Giovanelli: n 1.5, albedo 0.9, g 0: 0.2600
// with 0.0400 of it specular. Chandrasekhar's H-function: n 1, albedo 0.9 and 0.99.
TEST(PathTracer, MeetsHalfSpaces) {
  const auto source = beam_entry({});
  const TriangleMesh box = test_support::make_box({-200, -200, -200}, {200, 200, 0});
  const Result giovanelli = run(box, {0.9, 0.1, 0.0, 1.5}, *source, 100, 1000);
  EXPECT_LT(std::abs(giovanelli.up.z((0.2600 - 0.0400) / 0.96)), test_support::kSigmas);
  EXPECT_LT(giovanelli.up.std_error(), 1.5e-3);
  const Result h90 = run(box, {0.9, 0.1, 0.0, 1.0}, *source, 100, 1000);
  EXPECT_LT(std::abs(h90.up.z(0.414947)), test_support::kSigmas);
  EXPECT_LT(h90.up.std_error(), 1.5e-3);
}

// A body of 98304 triangles by rays, and its 12 by planes; the same also holds the road over an
// outside that light may cross again.
TEST(PathTracer, FineTrianglesChangeNothing) {
  const auto source = beam_entry({{-9, -9, 20}, {18, 0, 0}, {0, 18, 0}, {0, 0, -1}});
  const ScatteringMedium medium{0.8, 0.004, 0.3, 1.3};
  const TriangleMesh cube = test_support::make_cube();
  const Result coarse = run(cube, medium, *source, 20, 200);
  const Result fine =
      run(cut_finer(cube, 6), medium, *source, 20, 200, PathBoundary::Method::kRays);
  // The same random numbers: paths part only where float and double fall on two sides of a step.
  EXPECT_NEAR(fine.audit.escaped, coarse.audit.escaped, 1e-3 * coarse.audit.escaped);
  EXPECT_NEAR(static_cast<double>(fine.audit.scatterings),
              static_cast<double>(coarse.audit.scatterings),
              1e-3 * static_cast<double>(coarse.audit.scatterings));
}

// Without absorption all that enters leaves, also from a body that is entered again.
TEST(PathTracer, LosesNothing) {
  TriangleMesh bowl = test_support::make_cube();
  bowl.vertices_mm.emplace_back(0, 0, 3);
  bowl.triangles.erase(bowl.triangles.begin() + 2, bowl.triangles.begin() + 4);
  for (const auto& [a, b] : {std::pair{4, 5}, {5, 7}, {7, 6}, {6, 4}}) {
    bowl.triangles.push_back({a, b, 8});
  }
  const auto source = beam_entry({{-9, -10, 1}, {18, 0, 0}, {0, 0, 18}, {0, 1, 0}});
  const Result r = run(bowl, {1.0, 0.0, 0.0, 1.4}, *source, 10, 500);
  EXPECT_NEAR(r.audit.escaped, r.audit.entered, 1e-9 * r.audit.entered);
  EXPECT_NEAR(r.audit.entered, 10.0, 1e-9);
}

// Number of scatterings and length re-weigh a path for another material: sigma_s 10 % up and
// sigma_a 5 % of sigma_s up, against paths of that material.
TEST(PathTracer, TellsWhatPerturbationNeeds) {
  const auto source = beam_entry({{-9, -9, 20}, {18, 0, 0}, {0, 18, 0}, {0, 0, -1}});
  const Result base = run(test_support::make_cube(), {1.0, 0.02, 0.5, 1.3}, *source, 60, 500);
  const Result there = run(test_support::make_cube(), {1.1, 0.07, 0.5, 1.3}, *source, 60, 500);
  const double there_mean = there.audit.escaped / 60;
  const double error = std::hypot(base.perturbed.std_error(), there.up.std_error());
  EXPECT_LT(std::abs(base.perturbed.mean() - there_mean), test_support::kSigmas * error);
  EXPECT_LT(error, 0.03 * there_mean);
}

}  // namespace
}  // namespace scattermeter
