#include "core/diffusion/source_cloud.h"

#include <cmath>
#include <cstddef>
#include <iterator>
#include <vector>

#include <gtest/gtest.h>

#include "tests/fixtures/core/boxes.h"

namespace scattermeter {
namespace {

// A cube whose top is lit with a density that rises linearly along x: 2 + x / 10 sr/mm^2 per
// corner.
IncidentLight sloped_top(const PatchMesh& patches) {
  IncidentLight light;
  for (int k = 0; k < patches.size(); ++k) {
    if (patches.normal(k).z() < 0.5) continue;
    const auto c = patches.corners_mm(k);
    light.lit.push_back({c, {2.0 + 0.1 * c[0].x(), 2.0 + 0.1 * c[1].x(), 2.0 + 0.1 * c[2].x()}, k});
  }
  return light;
}

// Integrals of the density rho = 2 + x/10 over the top, |x|, |y| <= 10 mm, in closed form:
// power 800 sr; mean x = ∫ x rho / 800 = (20 * 0.1 * 2000 / 3) / 800 = 5/3 mm; mean x^2 = mean y^2
// = 100/3 mm^2; the product of x and y vanishes.
TEST(SourceCloud, RootHoldsTheMomentsOfAllLight) {
  const PatchMesh patches(test_support::make_cube(), 3.0);
  const SourceCloud cloud(sloped_top(patches), {1, 2, 3});
  const SourceCloud::Node& root = cloud.nodes().front();
  EXPECT_NEAR(root.power, 800.0, 1e-3);
  EXPECT_NEAR(root.x, 5.0 / 3.0 - 1.0, 1e-5);
  EXPECT_NEAR(root.y, -2.0, 1e-5);
  EXPECT_NEAR(root.z, 20.0 - 3.0, 1e-5);
  EXPECT_NEAR(root.xx, 100.0 / 3.0 - 25.0 / 9.0, 1e-4);
  EXPECT_NEAR(root.yy, 100.0 / 3.0, 1e-4);
  EXPECT_NEAR(root.xy, 0.0, 1e-4);
  EXPECT_NEAR(root.zz, 0.0, 1e-4);
}

TEST(SourceCloud, ChildrenSumUpToTheirParentAndLieWithinIt) {
  const PatchMesh patches(test_support::make_cube(), 3.0);
  const SourceCloud cloud(sloped_top(patches), {0, 0, 10});
  const std::vector<SourceCloud::Node>& nodes = cloud.nodes();
  ASSERT_EQ(nodes.size(), 2 * cloud.size() - 1);
  std::size_t leaves = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const SourceCloud::Node& node = nodes[i];
    if (node.right < 0) {
      // Leaves have their rules in the order of the tree.
      EXPECT_EQ(static_cast<std::size_t>(node.triangle), leaves++);
      continue;
    }
    const SourceCloud::Node& left = nodes[i + 1];
    const SourceCloud::Node& right = nodes[static_cast<std::size_t>(node.right)];
    EXPECT_NEAR(left.power + right.power, node.power, 1e-5 * node.power);
    EXPECT_NEAR(left.power * left.x + right.power * right.x, node.power * node.x,
                1e-4 * node.power);
    for (const SourceCloud::Node* child : {&left, &right}) {
      EXPECT_LE(std::hypot(child->x - node.x, child->y - node.y, child->z - node.z),
                node.radius * 1.0001F);
    }
  }
  EXPECT_EQ(leaves, cloud.size());
}

// Both rules of points keep power and first moment of their triangle; the six points, exact to
// degree 4, also its second moments: those of the leaf.
TEST(SourceCloud, RulesKeepTheMomentsOfTheirTriangles) {
  const PatchMesh patches(test_support::make_cube(), 3.0);
  const SourceCloud cloud(sloped_top(patches), {0, 0, 10});
  for (const SourceCloud::Node& leaf : cloud.nodes()) {
    if (leaf.right >= 0) continue;
    const SourceCloud::Rule& rule = cloud.rules()[static_cast<std::size_t>(leaf.triangle)];
    const auto lanes = [](const auto& values) {
      return Eigen::Map<const Eigen::ArrayXf>(values, std::ssize(values));
    };
    const auto three = lanes(rule.three.power), six = lanes(rule.six.power);
    EXPECT_NEAR(three.sum(), leaf.power, 1e-5F * leaf.power);
    EXPECT_NEAR(six.sum(), leaf.power, 1e-5F * leaf.power);
    EXPECT_NEAR(rule.density * rule.area, leaf.power, 1e-5F * leaf.power);
    const float mean_x = rule.center.x() + (six * lanes(rule.six.x)).sum() / leaf.power;
    EXPECT_NEAR(rule.center.x() + (three * lanes(rule.three.x)).sum() / leaf.power, leaf.x, 1e-4);
    EXPECT_NEAR(mean_x, leaf.x, 1e-4);
    const Eigen::ArrayXf from_mean = lanes(rule.six.x) + rule.center.x() - mean_x;
    EXPECT_NEAR((six * from_mean.square()).sum() / leaf.power, leaf.xx, 1e-4);
  }
}

TEST(SourceCloud, IsEmptyWithoutLight) {
  const SourceCloud cloud(IncidentLight{}, {0, 0, 0});
  EXPECT_EQ(cloud.size(), 0U);
  EXPECT_TRUE(cloud.nodes().empty());
}

}  // namespace
}  // namespace scattermeter
