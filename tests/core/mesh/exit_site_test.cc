#include "core/mesh/exit_site.h"

#include <random>

#include <gtest/gtest.h>

#include "tests/fixtures/core/boxes.h"

namespace scattermeter {
namespace {

// The points stand for the samples: mean and covariance are theirs, on slanted patches too, and a
// patch that is sampled evenly keeps its own points.
TEST(ExitSite, SamplesKeepTheirMoments) {
  const PatchMesh patches(test_support::make_cube(), 3.0);
  std::mt19937 random(12);
  std::uniform_real_distribution<double> uniform;
  for (int k = 0; k < patches.size(); k += 7) {
    const auto c = patches.corners_mm(k);
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    Eigen::Matrix3d square = Eigen::Matrix3d::Zero();
    for (int i = 0; i < 30; ++i) {
      const double u = uniform(random), v = (1.0 - u) * uniform(random);
      const Eigen::Vector3d p = u * (c[1] - c[0]) + v * (c[2] - c[0]);
      mean += p / 30.0;
      square += p * p.transpose() / 30.0;
    }
    const Eigen::Matrix3d covariance = square - mean * mean.transpose();
    const ExitSite site = exit_samples(patches, k, c[0] + mean, covariance);
    double weight = 0.0;
    Eigen::Vector3d site_mean = Eigen::Vector3d::Zero();
    Eigen::Matrix3d site_covariance = Eigen::Matrix3d::Zero();
    for (std::size_t i = 0; i < 6; ++i) {
      const Eigen::Vector3d d = site.points_mm[i] - (c[0] + mean);
      weight += site.weights[i];
      site_mean += site.weights[i] * d;
      site_covariance += site.weights[i] * d * d.transpose();
    }
    EXPECT_NEAR(weight, 1.0, 1e-12);
    EXPECT_LT(site_mean.norm(), 1e-12);
    EXPECT_LT((site_covariance - covariance).norm(), 1e-12);
    EXPECT_LT((site.covariance_mm2 - covariance).norm(), 1e-12);

    const ExitSite whole = exit_patch(patches, k);
    const ExitSite same = exit_samples(patches, k, whole.center_mm, whole.covariance_mm2);
    for (std::size_t i = 0; i < 6; ++i) {
      EXPECT_LT((same.points_mm[i] - whole.points_mm[i]).norm(), 1e-9);
    }
    EXPECT_EQ(exit_samples(patches, k, c[0], Eigen::Matrix3d::Zero()).n_points, 1);
  }
}

}  // namespace
}  // namespace scattermeter
