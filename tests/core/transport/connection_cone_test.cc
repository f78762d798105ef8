// Connections to the camera against what leaves toward it.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "core/transport/path_blocks.h"
#include "tests/fixtures/core/block_mean.h"
#include "tests/fixtures/core/boxes.h"
#include "tests/fixtures/core/bumps.h"
#include "tests/fixtures/draws.h"

namespace scattermeter {
namespace {

// Connections against escapes: light within a cone of directions that leaves a small box, by face
// and by distance from its edges, where reflections inside are a large part of it. Each block has a
// distant camera of its own, drawn evenly from the same cone, so that both are the mean of l over
// the cone; of an escape that is pi weight / (cos Ft(cos) times the cone's solid angle).
struct Cone {
  Eigen::Vector3d axis = Eigen::Vector3d(1, -1, 1).normalized();
  double cos_half = 0.93;
};

struct ConeSums {
  static constexpr int kBins = 6;
  const TriangleMesh* mesh;
  Cone cone;
  double eta;
  std::array<double, kBins> escaped{}, seen{};

  // Face x, y or z, within 0.4 mm of its edges or not; -1: a face away from the cone.
  int bin(const PathScore& s) const {
    const Eigen::Vector3d n = area_vector_mm2(*mesh, s.facet_idx).normalized();
    int face = 0;
    if (n.cwiseAbs().maxCoeff(&face) < 0.5 || n.dot(cone.axis) < 0.0) return -1;
    const Box3d box = bounds(*mesh);
    double edge_mm = 1e9;
    for (int i = 0; i < 3; ++i) {
      if (i == face) continue;
      edge_mm = std::min({edge_mm, s.point_mm[i] - box.min_mm[i], box.max_mm[i] - s.point_mm[i]});
    }
    return 2 * face + (edge_mm < 0.4 ? 1 : 0);
  }
  void escape(const PathScore& s) {
    const int b = bin(s);
    if (b < 0 || cone.axis.dot(s.direction) < cone.cos_half) return;
    const double cosine = area_vector_mm2(*mesh, s.facet_idx).normalized().dot(s.direction);
    const double solid_angle = 2.0 * std::numbers::pi * (1.0 - cone.cos_half);
    escaped[static_cast<std::size_t>(b)] +=
        std::numbers::pi * s.weight / (cosine * fresnel_transmittance(eta, cosine) * solid_angle);
  }
  void camera(const PathScore& s) {
    if (const int b = bin(s); b >= 0) seen[static_cast<std::size_t>(b)] += s.weight;
  }
};

// A direction drawn evenly from the cone.
Eigen::Vector3d drawn_from(const Cone& cone, RandomStream& random) {
  const double cosine = 1.0 - (1.0 - cone.cos_half) * random.uniform();
  const double around = 2.0 * std::numbers::pi * random.uniform();
  const Eigen::Vector3d u = cone.axis.unitOrthogonal();
  return cosine * cone.axis + std::sqrt(1.0 - cosine * cosine) *
                                  (std::cos(around) * u + std::sin(around) * cone.axis.cross(u));
}

// What escapes and what is seen, by bins.
template <std::size_t kBins>
struct Bins {
  std::array<test_support::BlockMean, kBins> escaped, seen;
  void add(const std::array<double, kBins>& out, const std::array<double, kBins>& in) {
    for (std::size_t i = 0; i < kBins; ++i) {
      escaped[i].add(out[i]);
      seen[i].add(in[i]);
    }
  }
  // And their errors are small, relative to what is seen: in the first bin, in the others.
  void expect_alike(double first_error, double other_error) const {
    for (std::size_t i = 0; i < kBins; ++i) {
      const double error = std::hypot(escaped[i].std_error(), seen[i].std_error());
      EXPECT_LT(std::abs(seen[i].mean() - escaped[i].mean()), test_support::kSigmas * error)
          << "bin " << i << ": " << seen[i].mean() << " seen, " << escaped[i].mean() << " escaped";
      EXPECT_LT(error, (i == 0 ? first_error : other_error) * seen[i].mean()) << "bin " << i;
    }
  }
};

TEST(ConnectionConeStatistics, SeesWhatEscapes) {
  const int blocks = test_support::draws(200, 800);
  const RayScene scene(test_support::make_box({0, 0, 0}, {4, 4, 3}));
  const PathBoundary boundary(scene);
  const ScatteringMedium medium{1.0, 0.05, 0.3, 1.3};
  const auto source = beam_entry({{0.5, 0.5, 3}, {3, 0, 0}, {0, 3, 0}, {0, 0, -1}});
  const Cone cone;
  Bins<ConeSums::kBins> bins;
  RandomStream random(77, 0);
  for (int block = 0; block < blocks; ++block) {
    const Eigen::Vector3d toward = drawn_from(cone, random);
    const CameraConnection camera(boundary, 1e5 * toward, medium);
    trace_blocks<ConeSums>(
        {boundary, medium, *source, &camera}, {}, block, block + 1,
        [&] {
          return ConeSums{&scene.mesh(), cone, 1.3, {}, {}};
        },
        [&](const ConeSums& s, const PathAudit&) { bins.add(s.escaped, s.seen); });
  }
  const double error = test_support::limit_at(0.012, 800, blocks);
  bins.expect_alike(error, error);
}

// The same for bodies of many facets, as power per solid angle toward the cone (which no facet seen
// at a grazing angle can blow up): of an escape its weight over the cone's solid angle, of a
// connection l cos Ft(cos) / pi. By the cosine at which the facet is seen. Of escapes those that
// come straight from a scattering, which are what is connected; and the rest.
struct ConePower {
  static constexpr int kBins = 5;
  const PathBoundary* boundary;
  Cone cone;
  double eta;
  std::array<double, kBins> escaped{}, seen{};
  double all = 0.0, rest = 0.0, rest_seen = 0.0;

  double cosine(const PathScore& s) const {
    return std::max(0.0, boundary->facet_normal(s.facet_idx).dot(s.direction));
  }
  std::size_t bin(const PathScore& s) const {
    return static_cast<std::size_t>(std::min(kBins - 1, static_cast<int>(kBins * cosine(s))));
  }
  void escape(const PathScore& s) {
    if (cone.axis.dot(s.direction) < cone.cos_half) return;
    const double per_sr = s.weight / (2.0 * std::numbers::pi * (1.0 - cone.cos_half));
    all += per_sr;
    (s.straight ? escaped[bin(s)] : rest) += per_sr;
  }
  void camera(const PathScore& s) {
    (s.straight ? seen[bin(s)] : rest_seen) +=
        s.weight * cosine(s) * fresnel_transmittance(eta, cosine(s)) / std::numbers::pi;
  }
};

struct Rest {
  test_support::BlockMean all, escaped, seen;
};
Rest expect_power_that_escapes(const TriangleMesh& mesh, const ScatteringMedium& medium) {
  const int blocks = test_support::draws(100, 300);
  const RayScene scene(mesh);
  const PathBoundary boundary(scene);
  const Cone cone;
  Led led;
  led.position_mm = {30, -60, 80};
  led.axis = -led.position_mm.normalized();
  const auto source = led_entry(scene, led, medium.eta_int_over_ext);
  Bins<ConePower::kBins> bins;
  Rest rest;
  RandomStream random(78, 0);
  for (int block = 0; block < blocks; ++block) {
    const CameraConnection camera(boundary, 1e4 * drawn_from(cone, random), medium);
    trace_blocks<ConePower>(
        {boundary, medium, *source, &camera}, {}, block, block + 1,
        [&] { return ConePower{&boundary, cone, medium.eta_int_over_ext, {}, {}, 0.0, 0.0, 0.0}; },
        [&](const ConePower& s, const PathAudit& audit) {
          EXPECT_LE(audit.lost_paths, 2);
          rest.all.add(s.all);
          rest.escaped.add(s.rest);
          rest.seen.add(s.rest_seen);
          bins.add(s.escaped, s.seen);
        });
  }
  bins.expect_alike(test_support::limit_at(0.06, 300, blocks),
                    test_support::limit_at(0.02, 300, blocks));
  return rest;
}

TEST(ConnectionConeStatistics, SeesWhatEscapesFromASphere) {
  const Rest rest =
      expect_power_that_escapes(test_support::make_sphere(10, 4), {1.0, 0.01, 0.3, 1.3});
  EXPECT_LT(rest.escaped.mean(), 0.001 * rest.all.mean());
}

// Shadows, and light that leaves and enters again: that is the rest, averaged over a cone of its
// own around each camera.
TEST(ConnectionConeStatistics, SeesWhatEscapesFromBumps) {
  const Rest rest =
      expect_power_that_escapes(test_support::make_bumps(10, 0.4, 4), {1.0, 0.01, 0.3, 1.3});
  EXPECT_GT(rest.escaped.mean(), 0.003 * rest.all.mean());
  const double error = std::hypot(rest.escaped.std_error(), rest.seen.std_error());
  EXPECT_LT(std::abs(rest.seen.mean() - rest.escaped.mean()),
            test_support::kSigmas * error + 0.1 * rest.escaped.mean());
  EXPECT_LT(error,
            test_support::limit_at(0.1, 300, test_support::draws(100, 300)) * rest.escaped.mean());
}

// Through rough boundaries: what meets one microfacet as it leaves is connected, the rest is
// averaged over a cone.
void expect_power_that_escapes_roughly(const TriangleMesh& mesh, double alpha) {
  const Rest rest = expect_power_that_escapes(mesh, {1.0, 0.01, 0.3, 1.4, alpha});
  const double error = std::hypot(rest.escaped.std_error(), rest.seen.std_error());
  EXPECT_LT(std::abs(rest.seen.mean() - rest.escaped.mean()),
            test_support::kSigmas * error + 0.1 * rest.escaped.mean());
}

TEST(ConnectionConeStatistics, SeesWhatEscapesFromARoughSphere) {
  expect_power_that_escapes_roughly(test_support::make_sphere(10, 4), 0.3);
}

TEST(ConnectionConeStatistics, SeesWhatEscapesFromRoughBumps) {
  expect_power_that_escapes_roughly(test_support::make_bumps(10, 0.4, 4), 0.3);
}

// Light that was reflected inside, of a box whose bottom is cut in planes that differ by
// nanometres: by the cone what images give where the planes are few. Images in three walls and more
// are left out there, and the light bends a little over the cone: a tenth of it.
struct Reflected {
  double all = 0.0, reflected = 0.0;
  void escape(const PathScore&) {}
  void camera(const PathScore& s) {
    all += s.weight;
    if (!s.straight) reflected += s.weight;
  }
};

TEST(CameraConnectionCone, SeesReflectionsByEscapes) {
  const TriangleMesh box = test_support::make_box({0, 0, 0}, {8, 8, 6});
  TriangleMesh cut = cut_finer(box, 3);
  for (Eigen::Vector3d& v : cut.vertices_mm) {
    if (v.z() != 0.0) continue;
    v.z() -= 1e-5 * (1.0 - (v.head<2>() - Eigen::Vector2d(4.1, 4.2)).squaredNorm() / 40.0);
  }
  const RayScene box_scene(box), cut_scene(cut);
  const PathBoundary few(box_scene), many(cut_scene);
  ASSERT_TRUE(many.body().planes.empty());
  const ScatteringMedium medium{2.0, 0.002, 0.0, 1.3};
  const Eigen::Vector3d eye(100, -100, 100);
  const auto source = beam_entry({{0.5, 0.5, 6}, {7, 0, 0}, {0, 7, 0}, {0, 0, -1}});
  const auto reflected = [&](const PathBoundary& boundary) {
    const CameraConnection camera(boundary, eye, medium);
    test_support::BlockMean mean;
    double all = 0.0;
    trace_blocks<Reflected>(
        {boundary, medium, *source, &camera}, {}, 0, 250, [] { return Reflected(); },
        [&](const Reflected& s, const PathAudit&) {
          mean.add(s.reflected);
          all += s.all;
        });
    EXPECT_NEAR(mean.sum / all, 0.02, 0.005);
    return mean;
  };
  const test_support::BlockMean by_images = reflected(few);
  const test_support::BlockMean by_cone = reflected(many);
  const double error = std::hypot(by_images.std_error(), by_cone.std_error());
  EXPECT_LT(std::abs(by_cone.mean() - by_images.mean()),
            test_support::kSigmas * error + 0.1 * by_images.mean());
  EXPECT_LT(error, 0.06 * by_images.mean());
}

}  // namespace
}  // namespace scattermeter
