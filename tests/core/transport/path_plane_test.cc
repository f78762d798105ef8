#include "core/transport/path_plane.h"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "core/material/fresnel.h"
#include "core/transport/path_blocks.h"
#include "tests/fixtures/core/block_mean.h"
#include "tests/fixtures/core/boxes.h"
#include "tests/fixtures/core/spheres.h"

namespace scattermeter {
namespace {

struct PlaneEscapes {
  double all = 0, seen = 0;
  void escape(const PathScore& s) { all += s.weight; }
  void camera(const PathScore& s) { seen += s.weight * s.point_mm.x(); }
};

struct PlaneResult {
  PathAudit audit;  // mean per block
  test_support::BlockMean in_plane, escaped;
  double seen = 0;
};

PlaneResult run(const TriangleMesh& mesh, const ScatteringMedium& medium, const EntrySource& source,
                const std::optional<DiffusePlane>& plane, int blocks, int paths_per_block,
                const Eigen::Vector3d& camera_mm = {100, -150, 120}) {
  const RayScene scene(mesh);
  const PathBoundary boundary(scene);
  const CameraConnection camera = CameraConnection(boundary, camera_mm, medium).with(medium, plane);
  PathOptions options;
  options.paths_per_block = paths_per_block;
  PlaneResult out;
  trace_blocks<PlaneEscapes>(
      {boundary, medium, source, &camera, plane}, options, 0, blocks, [] { return PlaneEscapes(); },
      [&](const PlaneEscapes& s, const PathAudit& audit) {
        EXPECT_NEAR(s.all, audit.escaped, 1e-12 * audit.entered);
        EXPECT_NEAR(audit.entered,
                    audit.absorbed + audit.in_plane + audit.escaped + audit.roulette + audit.lost,
                    1e-9 * audit.entered);
        EXPECT_EQ(audit.lost_paths, 0);
        out.audit += audit;
        out.in_plane.add(audit.in_plane);
        out.escaped.add(audit.escaped);
        out.seen += s.seen;
      });
  return out;
}

// Mean of f over a Lambertian distribution, by the middle of many steps.
template <class F>
double diffuse_mean(const F& f) {
  constexpr int kSteps = 20000;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) sum += f(std::sqrt((i + 0.5) / kSteps));
  return sum / kSteps;
}

const auto kBeamDown = [] {
  return beam_entry({{0.1, 0.2, 1.0}, {0, 0, 0}, {0, 0, 0}, {0, 0, -1}});
};
const TriangleMesh kWideSlab = test_support::make_box({-400, -400, 0}, {400, 400, 1});
constexpr double kClear = 1e-7;  // sigma_s per mm: nothing is scattered

// A clear slab on a plane without a gap: the plane's light leaves with 1 - r, r the diffuse
// reflectance from inside, and the rest meets the plane again.
TEST(PathPlane, ClearSlabInOpticalContactIsAGeometricSeries) {
  constexpr double kEta = 1.5;
  constexpr double kAlbedo = 0.6;
  const double r =
      1.0 - diffuse_mean([](double c) { return fresnel_transmittance(1.0 / kEta, c); });
  const PlaneResult result = run(kWideSlab, {kClear, 0.0, 0.0, kEta}, *kBeamDown(),
                                 DiffusePlane{0.0, kAlbedo, PlaneContact::kOptical}, 40, 2000);
  EXPECT_LT(std::abs(result.in_plane.z((1.0 - kAlbedo) / (1.0 - kAlbedo * r))),
            test_support::kSigmas);
  EXPECT_LT(result.in_plane.std_error(), 2e-3);
}

// With a gap, thin or 1 mm wide: between the two faces of the slab, light of one direction leaves
// through the upper one with probability 1 / (1 + R), R of one face.
TEST(PathPlane, ClearSlabAboveAGapIsAGeometricSeries) {
  constexpr double kEta = 1.5;
  constexpr double kAlbedo = 0.6;
  const double leaves = diffuse_mean([](double c) {
    const double t = fresnel_transmittance(kEta, c);
    return t / (2.0 - t);
  });
  const double first = 1.0 / (2.0 - fresnel_transmittance(kEta, 1.0));
  const double expected = first * (1.0 - kAlbedo) / (1.0 - kAlbedo * (1.0 - leaves));
  for (const double z_mm : {0.0, -1.0}) {
    const PlaneResult result = run(kWideSlab, {kClear, 0.0, 0.0, kEta}, *kBeamDown(),
                                   DiffusePlane{z_mm, kAlbedo, PlaneContact::kAir}, 40, 2000);
    EXPECT_LT(std::abs(result.in_plane.z(expected)), test_support::kSigmas)
        << z_mm << ": " << result.in_plane.mean() << " for " << expected;
    EXPECT_LT(result.in_plane.std_error(), 2e-3);
  }
}

// What leaves towards a black spot is absorbed; a white plane around it gives all back.
TEST(PathPlane, BlackContactAbsorbsWhatLeavesThroughIt) {
  const PlaneResult result = run(kWideSlab, {kClear, 0.0, 0.0, 1.5}, *kBeamDown(),
                                 DiffusePlane{0.0, 1.0, PlaneContact::kBlack}, 40, 2000);
  EXPECT_LT(std::abs(result.in_plane.z(1.0 / (2.0 - fresnel_transmittance(1.5, 1.0)))),
            test_support::kSigmas);
}

// Nothing absorbs: all power leaves, whatever lies on or hangs above the plane.
TEST(PathPlane, WhitePlaneAbsorbsNothing) {
  const auto source = beam_entry({{-2, -2, 2}, {4, 0, 0}, {0, 4, 0}, {0, 0, -1}});
  for (const TriangleMesh& mesh :
       {test_support::make_box({-5, -5, -5}, {5, 5, 5}), test_support::make_sphere(6.0, 3)}) {
    for (const PlaneContact contact : {PlaneContact::kAir, PlaneContact::kOptical}) {
      for (const double below_mm : {0.0, 0.7, 100.0}) {
        const double z_mm = bounds(mesh).min_mm.z() - below_mm;
        const PlaneResult r =
            run(mesh, {1.0, 0.0, 0.3, 1.4}, *source, DiffusePlane{z_mm, 1.0, contact}, 4, 500);
        EXPECT_NEAR(r.audit.escaped, r.audit.entered, 1e-9 * r.audit.entered);
        EXPECT_EQ(r.audit.in_plane, 0.0);
      }
    }
  }
}

// The share of light that meets the plane again is one of geometry: of a small body at a height,
// with all its light leaving evenly, half of it goes down. An absorbing plane takes that half.
TEST(PathPlane, SphereSendsHalfOfItsLightDown) {
  const auto source = beam_entry({{-0.1, -0.1, 4.8}, {0.2, 0, 0}, {0, 0.2, 0}, {0, 0, -1}});
  // So dilute that light is scattered about once in 50 passages: even in all directions.
  const PlaneResult r = run(test_support::make_sphere(5.0, 3), {0.002, 0.0, 0.0, 1.0}, *source,
                            DiffusePlane{-50.0, 0.0, PlaneContact::kAir}, 20, 4000);
  // The unscattered share, exp(-0.002 * 9.75), goes straight down.
  const double straight = std::exp(-0.002 * 9.75);
  EXPECT_LT(std::abs(r.in_plane.z(straight + 0.5 * (1.0 - straight))), test_support::kSigmas);
}

// A plane that reflects nothing takes what would have escaped downwards, and no score of the camera
// differs in any digit: convex by planes, by rays, and a body that light may enter again.
TEST(PathPlane, DarkPlaneChangesNoDigit) {
  const auto source = beam_entry({{-2, -2, 2}, {4, 0, 0}, {0, 4, 0}, {0, 0, -1}});
  TriangleMesh two = test_support::make_box({-5, -5, -5}, {5, 5, 5});
  const TriangleMesh other = test_support::make_box({6, -5, -5}, {9, 5, 7});
  for (const auto& t : other.triangles) two.triangles.push_back({t[0] + 8, t[1] + 8, t[2] + 8});
  two.vertices_mm.insert(two.vertices_mm.end(), other.vertices_mm.begin(), other.vertices_mm.end());
  for (const TriangleMesh& mesh :
       {test_support::make_box({-5, -5, -5}, {5, 5, 5}), test_support::make_sphere(7.0, 3), two}) {
    const ScatteringMedium medium{0.7, 0.004, 0.3, 1.4};
    const double z_mm = bounds(mesh).min_mm.z();
    const PlaneResult none = run(mesh, medium, *source, std::nullopt, 3, 1000);
    const PlaneResult dark = run(mesh, medium, *source, DiffusePlane{z_mm, 0.0}, 3, 1000);
    EXPECT_EQ(none.seen, dark.seen);
    EXPECT_EQ(none.audit.absorbed, dark.audit.absorbed);
    EXPECT_EQ(none.audit.scatterings, dark.audit.scatterings);
    EXPECT_NEAR(none.audit.escaped, dark.audit.escaped + dark.audit.in_plane, 1e-12);
    EXPECT_GT(dark.audit.in_plane, 0.1);
  }
}

}  // namespace
}  // namespace scattermeter
