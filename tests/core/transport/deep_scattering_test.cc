#include "core/transport/deep_scattering.h"

#include <limits>

#include <gtest/gtest.h>

#include "core/transport/path_blocks.h"
#include "core/transport/path_tracer.h"
#include "tests/fixtures/core/block_mean.h"
#include "tests/fixtures/core/boxes.h"
#include "tests/fixtures/core/spheres.h"

namespace scattermeter {
namespace {

using test_support::BlockMean;
using test_support::kSigmas;

// Light of a beam into the origin that leaves within two and a half transport mean free paths, and
// elsewhere.
struct BeamEscapes {
  double near = 0, far = 0;
  void escape(const PathScore& s) { (s.point_mm.norm() < 0.5 ? near : far) += s.weight; }
  void camera(const PathScore&) {}
};

struct EscapedLight {
  BlockMean near, far;
  PathAudit audit;
};

EscapedLight escaped(const TriangleMesh& mesh, const PhaseFunction& phase, double isotropic_beyond,
                     int blocks = 100) {
  const RayScene scene(mesh);
  const PathBoundary boundary(scene);
  const ScatteringMedium medium = scattering_medium({5.0, 0.05, 1.4}, phase);
  const auto source = beam_entry({});
  PathOptions options;
  options.paths_per_block = 400;
  options.isotropic_beyond = isotropic_beyond;
  EscapedLight out;
  trace_blocks<BeamEscapes>(
      {boundary, medium, *source, nullptr}, options, 0, blocks, [] { return BeamEscapes(); },
      [&](const BeamEscapes& s, const PathAudit& audit) {
        EXPECT_NEAR(audit.entered, audit.absorbed + audit.escaped + audit.roulette + audit.lost,
                    1e-9 * audit.entered);
        out.audit += audit;
        out.near.add(s.near);
        out.far.add(s.far);
      });
  return out;
}

double sigmas_between(const BlockMean& a, const BlockMean& b) {
  return std::abs(a.mean() - b.mean()) / std::hypot(a.std_error(), b.std_error());
}

TriangleMesh box() { return test_support::make_box({-2, -2, -4}, {2, 2, 0}); }

TEST(DeepScattering, IsOfTheSameReducedCoefficients) {
  const DeepScattering deep(scattering_medium({2.0, 0.5, 1.4}, 0.8), 3.0);
  EXPECT_NEAR(deep.mean_free_path_mm, 1.0 / 2.5, 1e-12);
  EXPECT_NEAR(deep.albedo, 2.0 / 2.5, 1e-12);
  EXPECT_NEAR(deep.least_mm, 1.5, 1e-12);
  // Nine mean free paths of the medium itself, from where nothing is seen.
  const DeepScattering seen(scattering_medium({2.0, 0.5, 1.4}, 0.5), 1.0);
  EXPECT_NEAR(seen.least_mm, 9.0 / 4.5, 1e-12);
  EXPECT_GT(deep.enters_mm, deep.least_mm);
}

// The light that leaves is that of the exact paths, from fewer scatterings, and the test would
// notice if it were not: isotropic scattering from the surface on lets out other light.
TEST(DeepScattering, LeavesTheLightAsItIs) {
  for (const TriangleMesh& mesh : {box(), test_support::make_sphere(2.0, 4)}) {
    TriangleMesh at_origin = mesh;
    const double top_mm = bounds(mesh).max_mm.z();
    for (Eigen::Vector3d& v : at_origin.vertices_mm) v.z() -= top_mm;
    const EscapedLight exact = escaped(at_origin, 0.9, std::numeric_limits<double>::infinity());
    const EscapedLight deep = escaped(at_origin, 0.9, kIsotropicBeyond);
    EXPECT_LT(sigmas_between(exact.near, deep.near), kSigmas);
    EXPECT_LT(sigmas_between(exact.far, deep.far), kSigmas);
    EXPECT_LT(deep.near.std_error(), 0.01 * deep.near.mean());
    EXPECT_LT(deep.far.std_error(), 0.01 * deep.far.mean());
    EXPECT_LT(static_cast<double>(deep.audit.scatterings),
              0.75 * static_cast<double>(exact.audit.scatterings));
    const EscapedLight isotropic = escaped(at_origin, {}, kIsotropicBeyond);
    EXPECT_GT(sigmas_between(exact.near, isotropic.near), 1.5 * kSigmas);
  }
}

TEST(DeepScattering, IsotropicScatteringKeepsItsDigits) {
  const EscapedLight a = escaped(box(), {}, std::numeric_limits<double>::infinity(), 2);
  const EscapedLight b = escaped(box(), {}, 0.0, 2);
  EXPECT_EQ(a.near.sum, b.near.sum);
  EXPECT_EQ(a.far.sum, b.far.sum);
}

}  // namespace
}  // namespace scattermeter
