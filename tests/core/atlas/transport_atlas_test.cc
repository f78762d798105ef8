#include "core/atlas/transport_atlas.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/fixtures/core/dipole_cube.h"

namespace scattermeter {
namespace {

class AtlasOfTheCube : public ::testing::Test {
 protected:
  AtlasOfTheCube() { cube_.show(test_support::kCubeMedium); }
  TransportAtlas::LitView& lit(TransportAtlas& atlas, std::size_t light, std::size_t channel) {
    return atlas.lit_view(cube_.scene, *cube_.shots[0].seen, cube_.scene.lights[light], channel,
                          {1.3});
  }
  // Under the first light, from `rad` aside as seen from the cube.
  TransportAtlas::LitView& aside_of(TransportAtlas& atlas, double rad) {
    SeenObject seen = *cube_.shots[0].seen;
    const Eigen::Vector3d to = seen.camera_center_mm - seen.object->box.center_mm();
    seen.camera_center_mm += rad * to.norm() * to.unitOrthogonal();
    return atlas.lit_view(cube_.scene, seen, cube_.scene.lights[0], 0, {1.3});
  }
  test_support::DipoleCube cube_{2, 5.0};
};

TEST_F(AtlasOfTheCube, ChannelsShareTheNodesOfAnLed) {
  TransportAtlas atlas;
  TransportAtlas::LitView& red = lit(atlas, 0, 0);
  EXPECT_EQ(&lit(atlas, 0, 2), &red);
  EXPECT_NE(&lit(atlas, 1, 0), &red);
  EXPECT_EQ(red.missing_paths(1, 2), WhiteRows::paths_of(2));
  const std::shared_ptr<const WhiteRows> node = red.node(1, 2);
  EXPECT_EQ(red.missing_paths(1, 2), 0);
  EXPECT_EQ(red.missing_paths(1, 3), WhiteRows::paths_of(3) - WhiteRows::paths_of(2));
  EXPECT_EQ(red.node(1, 1), node);
  EXPECT_EQ(node->levels(), 2);
  EXPECT_NEAR(std::log(node->sigma_s_per_mm()), TransportAtlas::kSpacing, 1e-15);
}

// The digits of a node follow from what it is of, not from what was traced before it; no two nodes
// or lights share paths.
TEST_F(AtlasOfTheCube, DigitsDoNotDependOnTheOrder) {
  TransportAtlas one, other;
  const Eigen::VectorXd first = lit(one, 0, 0).node(0, 1)->light(0.01).l;
  lit(other, 1, 0).node(0, 1);
  lit(other, 0, 0).node(1, 1);
  EXPECT_EQ(lit(other, 0, 0).node(0, 1)->light(0.01).l, first);
  const Eigen::VectorXd second = lit(other, 1, 0).node(0, 1)->light(0.01).l;
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

// A store in memory, of one light of one body.
class ListedNodes : public AtlasStore {
 public:
  std::string name(const std::vector<double>& numbers) const override {
    std::string out;
    for (const double n : numbers) out += std::to_string(std::bit_cast<std::uint64_t>(n)) + " ";
    return out;
  }
  std::vector<Eigen::Vector3d> centers_mm(const std::string&) override {
    return {center_, center_ + Eigen::Vector3d(1e-3, 0, 0)};
  }
  std::optional<WhiteSums> find(const std::string& body, const Eigen::Vector3d& center_mm,
                                int node) override {
    const auto known = nodes_.find(node);
    if (known == nodes_.end() || body != body_ || center_mm != center_) return {};
    return known->second;
  }
  void keep(const std::string& body, const Eigen::Vector3d& center_mm, int node,
            const WhiteSums& sums) override {
    body_ = body;
    center_ = center_mm;
    nodes_[node] = sums;
  }

 private:
  std::string body_;
  Eigen::Vector3d center_ = Eigen::Vector3d::Zero();
  std::map<int, WhiteSums> nodes_;
};

// Another program takes the paths from the store and goes on from them, with the digits of one that
// traced all by itself.
TEST_F(AtlasOfTheCube, GoesOnFromTheStore) {
  const auto store = std::make_shared<ListedNodes>();
  TransportAtlas first(store), second(store), alone;
  lit(first, 0, 0).node(0, 2);
  EXPECT_EQ(lit(second, 0, 0).missing_paths(0, 2), 0);
  EXPECT_EQ(lit(second, 0, 0).missing_paths(1, 2), WhiteRows::paths_of(2));
  EXPECT_EQ(lit(second, 0, 0).node(0, 3)->sums().sum, lit(alone, 0, 0).node(0, 3)->sums().sum);
  // Nothing of another light, index or place below.
  EXPECT_GT(lit(second, 1, 0).missing_paths(0, 1), 0);
  EXPECT_GT(second.lit_view(cube_.scene, *cube_.shots[0].seen, cube_.scene.lights[0], 0, {1.31})
                .missing_paths(0, 1),
            0);
  EXPECT_GT(second.lit_view(cube_.scene, *cube_.shots[0].seen, cube_.scene.lights[0], 0, {1.3, 0.1})
                .missing_paths(0, 1),
            0);
  auto* led = cube_.scene.lights[0].led();
  led->led.position_mm.x() += 1e-6;
  TransportAtlas moved(store);
  EXPECT_GT(lit(moved, 0, 0).missing_paths(0, 1), 0);
}

// A camera that moved by less than kNearViews, seen from the object, sees the same nodes; farther
// off, it sees its own. The light differs by 3e-4 at most (core/atlas/transport_atlas.h).
TEST_F(AtlasOfTheCube, NearViewsShareTheirNodes) {
  TransportAtlas atlas(std::make_shared<ListedNodes>());
  TransportAtlas::LitView& straight = aside_of(atlas, 0.0);
  EXPECT_EQ(&aside_of(atlas, 0.9 * TransportAtlas::kNearViews), &straight);
  TransportAtlas::LitView& aside = aside_of(atlas, 30.0 * TransportAtlas::kNearViews);
  EXPECT_NE(&aside, &straight);
  const SeenObject& seen = *cube_.shots[0].seen;
  const int patch = seen.map.patch_of_row.front();
  ASSERT_GE(aside.row_of_patch(patch), 0);
  double there = 0.0, here = 0.0;
  const Eigen::VectorXd l = straight.node(0, 21)->light(0.01).l;
  const Eigen::VectorXd l_aside = aside.node(0, 21)->light(0.01).l;
  for (const int p : seen.map.patch_of_row) {
    here += seen.patches->area_mm2(p) * l[straight.row_of_patch(p)];
    there += seen.patches->area_mm2(p) * l_aside[aside.row_of_patch(p)];
  }
  // Thirty times as far off, up to thirty times as different.
  EXPECT_NEAR(there / here, 1.0, 0.02);
}

// Searches add the variances of different nodes up: two views that see almost the same must differ
// as independent paths do.
TEST_F(AtlasOfTheCube, ViewsApartHavePathsOfTheirOwn) {
  TransportAtlas atlas;
  const std::vector<int>& patches = cube_.shots[0].seen->map.patch_of_row;
  Eigen::VectorXd difference = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(patches.size()));
  double variance = 0.0;
  for (const double sign : {1.0, -1.0}) {
    TransportAtlas::LitView& view =
        aside_of(atlas, sign > 0.0 ? 0.0 : 2.0 * TransportAtlas::kNearViews);
    const std::shared_ptr<const WhiteRows> node = view.node(0, 5);
    const Eigen::VectorXd l = node->light(0.01).l;
    const Eigen::MatrixXd departures = node->departures(0.01).of_batch;
    for (std::size_t i = 0; i < patches.size(); ++i) {
      const Eigen::Index row = view.row_of_patch(patches[i]);
      difference[static_cast<Eigen::Index>(i)] += sign * l[row];
      variance += departures.col(row).squaredNorm();
    }
  }
  EXPECT_NEAR(difference.squaredNorm() / variance, 1.0, 0.4);
}

}  // namespace
}  // namespace scattermeter
