#include "calib/led/plane_cells.h"

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "tests/fixtures/calib/led_scenes.h"

namespace scattermeter::calib {
namespace {

constexpr std::array<double, 3> kOne = {1.0, 1.0, 1.0};

WhitePlane plane_of(double width_mm, double height_mm) {
  WhitePlane plane;
  plane.width_mm = width_mm;
  plane.height_mm = height_mm;
  plane.origin_mm = {-0.5 * width_mm, -0.5 * height_mm, 0};
  return plane;
}

// Signal a + b x on the plane (mm from its origin), absurd beside it.
CfaSamples samples_of(const WhitePlane& plane, double noise, std::uint64_t seed) {
  const CameraIntrinsics k = led_camera();
  const Rigid3d pose = led_camera_pose();
  const PlaneImage image = plane_image(k, pose, plane);
  CfaSamples s;
  s.x0 = image.x0;
  s.y0 = image.y0;
  s.width = image.width;
  s.height = image.height;
  s.channel_of_phase = {0, 1, 1, 2};
  s.exposure_s = 2.0;
  std::mt19937_64 generator(seed);
  std::normal_distribution<double> normal;
  const auto rays = pixel_rays_in_camera(k, s.x0, s.y0, s.width, s.height);
  const Eigen::Vector3d eye = inverse(pose).translation_mm;
  for (const Eigen::Vector3f& ray : rays) {
    const auto p = plane.meet_mm(eye, pose.rotation.conjugate() * ray.cast<double>());
    const bool on =
        p && p->x() > 0 && p->y() > 0 && p->x() < plane.width_mm && p->y() < plane.height_mm;
    const double v = on ? 1000.0 + 5.0 * p->x() : 1e7;
    s.signal_counts.push_back(static_cast<float>(v + noise * normal(generator)));
    s.variance_counts2.push_back(static_cast<float>(noise * noise));
    s.clipped.push_back(0);
  }
  return s;
}

TEST(PlaneCells, MeansAreThoseOfTheirPositions) {
  const WhitePlane plane = plane_of(50, 36);
  const CfaSamples samples = samples_of(plane, 10.0, 1);
  const PlaneCells cells = plane_cells(samples, led_camera(), led_camera_pose(), plane, kOne, 3, 4);
  ASSERT_GT(cells.cells.size(), 300U);
  EXPECT_EQ(cells.cells.size(), 3U * static_cast<std::size_t>(cells.columns * cells.rows));
  double chi2 = 0.0;
  for (const ShadedCell& cell : cells.cells) {
    EXPECT_EQ(cell.view, 3U);
    EXPECT_EQ(cell.plane, 4U);
    const double expected = (1000.0 + 5.0 * cell.on_plane_mm.x()) / 2.0;
    chi2 += std::pow((cell.radiance_W_per_mm2_sr - expected) / cell.std_W_per_mm2_sr, 2);
  }
  const double n = static_cast<double>(cells.cells.size());
  EXPECT_NEAR(chi2 / n, 1.0, 4.0 * std::sqrt(2.0 / n));
}

TEST(PlaneCells, DustAndBordersAreLeftOut) {
  const WhitePlane plane = plane_of(50, 36);
  CfaSamples samples = samples_of(plane, 10.0, 2);
  // Specks of 3 x 3 samples, 3 % of all.
  std::size_t specks = 0;
  for (int y = 20; y + 3 < samples.height; y += 17) {
    for (int x = 20; x + 3 < samples.width; x += 18) {
      for (int k = 0; k < 9; ++k) {
        samples.signal_counts[static_cast<std::size_t>((y + k / 3) * samples.width + x + k % 3)] *=
            0.4F;
      }
      ++specks;
    }
  }
  const PlaneCells cells = plane_cells(samples, led_camera(), led_camera_pose(), plane, kOne, 0, 0);
  EXPECT_GT(cells.spots, specks);
  double worst = 0.0;
  for (const ShadedCell& cell : cells.cells) {
    const double expected = (1000.0 + 5.0 * cell.on_plane_mm.x()) / 2.0;
    worst =
        std::max(worst, std::abs(cell.radiance_W_per_mm2_sr - expected) / cell.std_W_per_mm2_sr);
  }
  EXPECT_LT(worst, 6.0);
}

TEST(PlaneCells, ClippedCellsAreLeftOut) {
  const WhitePlane plane = plane_of(50, 36);
  CfaSamples samples = samples_of(plane, 10.0, 3);
  for (std::size_t i = 0; i < samples.clipped.size(); ++i) {
    if (samples.signal_counts[i] > 1150.0F) {
      samples.clipped[i] = 1;
      samples.signal_counts[i] = std::numeric_limits<float>::quiet_NaN();
    }
  }
  const PlaneCells cells = plane_cells(samples, led_camera(), led_camera_pose(), plane, kOne, 0, 0);
  EXPECT_GT(cells.clipped_cells, 50U);
  ASSERT_GT(cells.cells.size(), 50U);
  for (const ShadedCell& cell : cells.cells) {
    EXPECT_TRUE(std::isfinite(cell.radiance_W_per_mm2_sr));
    EXPECT_LT(cell.on_plane_mm.x(), 31.0);
  }
}

TEST(PlaneCells, NothingOfAPlaneThatIsNotSeen) {
  WhitePlane behind = plane_of(50, 36);
  behind.y_axis = -behind.y_axis;
  EXPECT_TRUE(
      plane_cells(CfaSamples{}, led_camera(), led_camera_pose(), behind, kOne, 0, 0).cells.empty());
}

}  // namespace
}  // namespace scattermeter::calib
