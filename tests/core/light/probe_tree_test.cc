#include "core/light/probe_tree.h"

#include <numbers>
#include <stdexcept>

#include <gtest/gtest.h>

#include "core/light/sky_probe.h"
#include "tests/fixtures/core/probes.h"

namespace scattermeter {
namespace {

// Nothing is lost between pixels, bright pixels and the sum at the root, for sizes that are no
// power of two as well.
TEST(ProbeTree, FluxIsConserved) {
  for (const ProbeProjection projection :
       {ProbeProjection::kEquirectangular, ProbeProjection::kAngularMap,
        ProbeProjection::kMirrorBall}) {
    const ProbeTree tree(test_support::even_probe(projection, 50, 37, {1, 2, 0}));
    EXPECT_TRUE(tree.bright().empty());
    EXPECT_NEAR(tree.sky_flux()[0], 4.0 * std::numbers::pi, 1e-5);
    EXPECT_NEAR(tree.sky_flux()[1], 8.0 * std::numbers::pi, 1e-5);
    EXPECT_EQ(tree.sky_flux()[2], 0.0);
    // An even sphere has no mean direction.
    EXPECT_LT(tree.sky(tree.root()).first.norm(), 1e-3);
  }
}

TEST(ProbeTree, SetsTheSunApart) {
  const Environment probe = make_sky_probe();
  const ProbeTree tree(probe);
  ASSERT_FALSE(tree.bright().empty());
  EXPECT_LT(tree.bright().size(), 20U);  // a disc of 0.54 degrees in pixels of 0.35
  const Eigen::Vector3d sun = SkyProbe().sun_direction.normalized();
  for (const ProbeCell& pixel : tree.bright()) {
    const Eigen::Vector3d d = tree.map().direction(pixel.x + 0.5, pixel.y + 0.5);
    EXPECT_GT(d.dot(sun), 0.9998);
    EXPECT_EQ(tree.sky(pixel).flux[1], 0.0);
    EXPECT_GT(tree.pixel(pixel).flux[1], 0.0);
  }
  double sum = 0.0;
  for (int y = 0; y < 512; ++y) {
    for (int x = 0; x < 1024; ++x) sum += tree.pixel({0, x, y}).flux[1];
  }
  EXPECT_NEAR(tree.sky_flux()[1] + tree.bright_flux()[1], sum, 1e-5 * sum);
}

TEST(ProbeTree, PartsOfAPixelMakeThePixel) {
  const ProbeTree tree(test_support::even_probe(ProbeProjection::kAngularMap, 100, 100, {1, 1, 1}));
  const ProbeCell pixel{0, 64, 37};
  ProbeLight sum;
  for (const ProbeCell& child : children(pixel)) sum += tree.sky(child);
  EXPECT_NEAR(sum.flux[0], tree.sky(pixel).flux[0], 1e-12);
  EXPECT_LT((sum.first - tree.sky(pixel).first).norm(), 1e-5 * sum.flux[0]);
}

TEST(ProbeTree, RefusesWhatIsNoProbe) {
  Environment probe = test_support::even_probe(ProbeProjection::kEquirectangular, 4, 2, {1, 1, 1});
  probe.radiance[5] = -1.0F;
  EXPECT_THROW(ProbeTree{probe}, std::invalid_argument);
}

}  // namespace
}  // namespace scattermeter
