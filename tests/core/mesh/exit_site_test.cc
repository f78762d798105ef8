#include "core/mesh/exit_site.h"

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "core/mesh/triangle_parts.h"
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
    const ExitSite site = exit_samples(patches, k, {1.0, c[0] + mean, covariance});
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
    const ExitSite same = exit_samples(patches, k, {1.0, whole.center_mm, whole.covariance_mm2});
    for (std::size_t i = 0; i < 6; ++i) {
      EXPECT_LT((same.points_mm[i] - whole.points_mm[i]).norm(), 1e-9);
    }
    EXPECT_EQ(exit_samples(patches, k, {1.0, c[0], Eigen::Matrix3d::Zero()}).n_points, 1);
  }
}

// Light that falls off by 1 / e over 0.7 patches, seen on the part of a patch beyond a guard band.
TEST(ExitSite, QuartersFollowSteepLightBesideAnEdge) {
  const PatchMesh patches(test_support::make_cube(), 3.0);
  const Triangle t = patches.corners_mm(0);
  const double size_mm = longest_edge_mm(t);
  const Eigen::Vector3d across =
      (middle_mm(t) - 0.5 * (t[1] + t[2])).normalized();  // from the edge into the patch
  const auto from_edge_mm = [&](const Eigen::Vector3d& p) { return (p - t[1]).dot(across); };
  const auto light = [&](const Eigen::Vector3d& p) {
    return std::exp(-from_edge_mm(p) / (0.7 * size_mm));
  };
  constexpr int kAcross = 60;
  for (const double guard : {0.1, 0.25}) {
    std::vector<Eigen::Vector3d> seen;
    double truth = 0.0;
    for (int i = 0; i < kAcross; ++i) {
      for (int j = 0; j < kAcross - i; ++j) {
        const Eigen::Vector3d p =
            t[0] + (i + 0.3) / kAcross * (t[1] - t[0]) + (j + 0.3) / kAcross * (t[2] - t[0]);
        if (from_edge_mm(p) < guard * size_mm) continue;
        seen.push_back(p);
        truth += light(p);
      }
    }
    const auto n = static_cast<double>(seen.size());
    truth /= n;
    const auto spread = [&](const auto& belongs) {
      SampleSpread out;
      double m = 0.0;
      for (const Eigen::Vector3d& p : seen) m += belongs(p) ? 1.0 : 0.0;
      if (m == 0.0) return out;
      out.share = m / n;
      for (const Eigen::Vector3d& p : seen) {
        if (belongs(p)) out.mean_mm += p / m;
      }
      for (const Eigen::Vector3d& p : seen) {
        if (!belongs(p)) continue;
        out.covariance_mm2 += (p - out.mean_mm) * (p - out.mean_mm).transpose() / m;
      }
      return out;
    };
    std::vector<SampleSpread> of_quarters;
    for (std::size_t q = 0; q < 4; ++q) {
      of_quarters.push_back(
          spread([&](const Eigen::Vector3d& p) { return quarter_of(t, p) == q; }));
    }
    const SampleSpread all = spread([](const Eigen::Vector3d&) { return true; });
    const auto mean_light = [&](const ExitSite& site) {
      double sum = 0.0;
      for (std::size_t i = 0; i < static_cast<std::size_t>(site.n_points); ++i) {
        sum += site.weights[i] * light(site.points_mm[i]);
      }
      return sum;
    };
    const double whole = std::abs(mean_light(exit_samples(patches, 0, all)) / truth - 1.0);
    const double parts =
        std::abs(mean_light(exit_samples(patches, 0, all, of_quarters)) / truth - 1.0);
    EXPECT_LT(parts, 5e-5) << guard;
    EXPECT_LT(parts, 0.2 * whole) << guard;
  }
}

}  // namespace
}  // namespace scattermeter
