#include "core/estimation/transport_atlas.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/fixtures/core/dipole_cube.h"

namespace scattermeter {
namespace {

class AtlasOfTheCube : public ::testing::Test {
 protected:
  AtlasOfTheCube() { cube_.show(test_support::kCubeMedium); }
  TransportAtlas::LitView& lit(TransportAtlas& atlas, std::size_t light, std::size_t channel) {
    return atlas.lit_view(cube_.scene, cube_.shots[0].seen, cube_.scene.lights[light], channel,
                          1.3);
  }
  test_support::DipoleCube cube_{2, 5.0};
};

TEST_F(AtlasOfTheCube, ChannelsShareTheNodesOfAnLed) {
  TransportAtlas atlas;
  TransportAtlas::LitView& red = lit(atlas, 0, 0);
  EXPECT_EQ(&lit(atlas, 0, 2), &red);
  EXPECT_NE(&lit(atlas, 1, 0), &red);
  EXPECT_EQ(red.missing_paths(1, 2), 2 * WhiteRows::kFirstPaths);
  const WhiteRows& node = red.node(1, 2);
  EXPECT_EQ(red.missing_paths(1, 2), 0);
  EXPECT_EQ(red.missing_paths(1, 3), 2 * WhiteRows::kFirstPaths);
  EXPECT_EQ(&red.node(1, 1), &node);
  EXPECT_EQ(node.levels(), 2);
  EXPECT_NEAR(std::log(node.sigma_s_per_mm()), TransportAtlas::kSpacing, 1e-15);
}

// The digits of a node follow from what it is of, not from what was traced before it; no two nodes
// or lights share paths.
TEST_F(AtlasOfTheCube, DigitsDoNotDependOnTheOrder) {
  TransportAtlas one, other;
  const Eigen::VectorXd first = lit(one, 0, 0).node(0, 1).light(0.01).l;
  lit(other, 1, 0).node(0, 1);
  lit(other, 0, 0).node(1, 1);
  EXPECT_EQ(lit(other, 0, 0).node(0, 1).light(0.01).l, first);
  const Eigen::VectorXd second = lit(other, 1, 0).node(0, 1).light(0.01).l;
  EXPECT_GT((second - first).norm(), 1e-3 * first.norm());
}

// Another albedo below the object has paths of its own.
TEST_F(AtlasOfTheCube, PlanesAreToldApart) {
  TransportAtlas atlas;
  TransportAtlas::LitView& stand = lit(atlas, 0, 0);
  cube_.scene.surroundings.plane.emplace();
  cube_.scene.surroundings.plane->z_mm = 0.0;
  cube_.scene.surroundings.plane->albedo = {0.3, 0.3, 0.5};
  TransportAtlas::LitView& bright = lit(atlas, 0, 0);
  EXPECT_NE(&bright, &stand);
  EXPECT_EQ(&lit(atlas, 0, 1), &bright);
  EXPECT_NE(&lit(atlas, 0, 2), &bright);
}

}  // namespace
}  // namespace scattermeter
