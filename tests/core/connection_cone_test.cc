// Connections to the camera against what leaves toward it.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "core/path_blocks.h"
#include "tests/core/block_mean.h"
#include "tests/core/boxes.h"

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

TEST(CameraConnectionCone, SeesWhatEscapes) {
  const RayScene scene(testing::make_box({0, 0, 0}, {4, 4, 3}));
  const PathBoundary boundary(scene);
  const ScatteringMedium medium{1.0, 0.05, 0.3, 1.3};
  const auto source = beam_entry({{0.5, 0.5, 3}, {3, 0, 0}, {0, 3, 0}, {0, 0, -1}});
  const Cone cone;
  std::array<testing::BlockMean, ConeSums::kBins> escaped, seen;
  RandomStream random(77, 0);
  for (int block = 0; block < 800; ++block) {
    const double cosine = 1.0 - (1.0 - cone.cos_half) * random.uniform();
    const double around = 2.0 * std::numbers::pi * random.uniform();
    const Eigen::Vector3d u = cone.axis.unitOrthogonal();
    const Eigen::Vector3d toward =
        cosine * cone.axis + std::sqrt(1.0 - cosine * cosine) *
                                 (std::cos(around) * u + std::sin(around) * cone.axis.cross(u));
    const CameraConnection camera(boundary, 1e5 * toward, medium);
    trace_blocks<ConeSums>(
        {boundary, medium, *source, &camera}, {}, block, block + 1,
        [&] {
          return ConeSums{&scene.mesh(), cone, 1.3, {}, {}};
        },
        [&](const ConeSums& s, const PathAudit&) {
          for (std::size_t i = 0; i < s.seen.size(); ++i) {
            escaped[i].add(s.escaped[i]);
            seen[i].add(s.seen[i]);
          }
        });
  }
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const double error = std::hypot(escaped[i].std_error(), seen[i].std_error());
    EXPECT_LT(std::abs(seen[i].mean() - escaped[i].mean()), testing::kSigmas * error)
        << "bin " << i;
    EXPECT_LT(error, 0.012 * seen[i].mean());
  }
}

}  // namespace
}  // namespace scattermeter
