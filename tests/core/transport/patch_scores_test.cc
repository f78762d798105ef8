#include "core/transport/patch_scores.h"

#include <stdexcept>

#include <gtest/gtest.h>

#include "tests/fixtures/core/block_mean.h"
#include "tests/fixtures/core/boxes.h"

namespace scattermeter {
namespace {

struct World {
  RayScene scene{test_support::make_cube()};
  PathBoundary boundary{scene};
  ScatteringMedium medium{1.0, 0.02, 0.0, 1.3};
  std::unique_ptr<EntrySource> source =
      beam_entry({{-9, -9, 20}, {18, 0, 0}, {0, 18, 0}, {0, 0, -1}});
  CameraConnection camera{boundary, {0, -100, 150}, medium};
  PatchMesh patches{scene.mesh(), 5.0};
  PathOptions options;
  World() { options.paths_per_block = 300; }
  PatchScores run(int first, int end) const {
    return patch_scores(patches, {boundary, medium, *source, &camera}, options, first, end);
  }
};

// A score is found on its patch, at its place.
TEST(PatchScores, FindsThePatch) {
  const World world;
  for (int k = 0; k < world.patches.size(); ++k) {
    PathScore score;
    score.facet_idx = world.patches.facet_idx(k);
    score.point_mm = world.patches.center_mm(k);
    const PatchPoint at =
        patch_of(world.patches, world.scene.mesh(), score.facet_idx, score.point_mm);
    EXPECT_EQ(at.patch_idx, k);
    EXPECT_LT((at.barycentric - Eigen::Vector3d::Constant(1.0 / 3.0)).norm(), 1e-9);
  }
}

// Disjoint blocks agree within the stated covariance: over lit patches and the three sums,
// ((a - b)^2 / var) is 1 in the mean.
TEST(PatchScores, StatesItsCovariance) {
  const World world;
  const PatchScores a = world.run(0, 40), b = world.run(40, 80);
  EXPECT_EQ(a.blocks, 40);
  EXPECT_NEAR(a.audit.entered, 1.0, 1e-9);
  test_support::BlockMean chi2;
  for (std::size_t k = 0; k < a.mean.size(); ++k) {
    if (!(a.mean[k][0] > 0.0)) continue;
    for (int i = 0; i < 3; ++i) {
      const double difference = a.mean[k][i] - b.mean[k][i];
      chi2.add(difference * difference / (a.covariance[k](i, i) + b.covariance[k](i, i)));
    }
    EXPECT_NEAR(a.covariance[k](0, 1), a.covariance[k](1, 0), 1e-12 * a.covariance[k](0, 0));
  }
  EXPECT_EQ(chi2.n, 96);
  EXPECT_NEAR(chi2.mean(), 1.0, 0.3);
  EXPECT_EQ(world.run(0, 40).mean[10], a.mean[10]);
}

// Sums of w n and w L are what the derivatives of all the light by the coefficients need.
TEST(PatchScores, DerivativesMeetDifferences) {
  World world;
  world.options.paths_per_block = 1000;
  const auto total = [](const PatchScores& s) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& m : s.mean) sum += m;
    return sum;
  };
  const Eigen::Vector3d at = total(world.run(0, 60));
  ScatteringMedium more = world.medium;
  more.sigma_a_per_mm += 0.004;
  const CameraConnection camera(world.boundary, {0, -100, 150}, more);
  const PatchScores up = patch_scores(world.patches, {world.boundary, more, *world.source, &camera},
                                      world.options, 0, 60);
  // Common random numbers; the second derivative is a tenth of the change.
  const double change = total(up)[0] - at[0];
  EXPECT_NEAR(change, -0.004 * at[2], 0.2 * std::abs(change));
}

TEST(PatchScores, RefusesOneBlock) {
  const World world;
  EXPECT_THROW(world.run(0, 1), std::invalid_argument);
}

}  // namespace
}  // namespace scattermeter
