#include "core/transport/volume_light.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/fixtures/core/boxes.h"
#include "tests/fixtures/core/spheres.h"

namespace scattermeter {
namespace {

TEST(VolumeLight, PartsEndAtFolds) {
  const TriangleMesh cube = test_support::make_cube();
  const std::vector<int> parts = smooth_parts(cube);
  for (std::size_t f = 0; f < parts.size(); ++f) {
    for (std::size_t g = 0; g < parts.size(); ++g) {
      EXPECT_EQ(parts[f] == parts[g], f / 2 == g / 2) << f << " " << g;
    }
  }
  for (int part : smooth_parts(test_support::make_sphere(5, 3))) EXPECT_EQ(part, 0);
}

// Where a face is lit evenly the field scatters about its mean as the stated error says.
TEST(VolumeLight, ProjectsTheScores) {
  const RayScene scene(test_support::make_cube());
  const PathBoundary boundary(scene);
  const ScatteringMedium medium{2.0, 0.5, 0.0, 1.3};
  const auto source = beam_entry({{-10, -10, 20}, {20, 0, 0}, {0, 20, 0}, {0, 0, -1}});
  const CameraConnection camera(boundary, {0, -1, 1e5}, medium);
  const PatchMesh patches(scene.mesh(), 2.0);
  std::vector<bool> needed(static_cast<std::size_t>(patches.size()));
  for (int k = 0; k < patches.size(); ++k) {
    needed[static_cast<std::size_t>(k)] = patches.normal(k).z() > 0.5;
  }
  SurfaceField field(patches, needed, smooth_parts(scene.mesh()));
  const VolumeLight light = volume_radiosity(field, patches, {boundary, medium, *source, &camera},
                                             {.seed = 3, .paths = 100'000});
  std::vector<Eigen::Array3d> values;
  for (double l : light.l_at_nodes) values.push_back(Eigen::Array3d::Constant(l));
  field.add(values);
  // Away from the edges l is even.
  double sum = 0.0, squares = 0.0;
  int n = 0;
  for (int k = 0; k < patches.size(); ++k) {
    const Eigen::Vector3d c = patches.center_mm(k);
    if (!needed[static_cast<std::size_t>(k)] || c.head<2>().cwiseAbs().maxCoeff() > 6.0) continue;
    // Mean of l and l^2 over a patch on which l is linear.
    double l1 = 0.0, l2 = 0.0;
    for (int i = 0; i < 3; ++i) {
      const double l = field.eval({k, Eigen::Vector3d::Unit(i)})[0];
      l1 += l;
      l2 += l * l;
    }
    sum += l1 / 3.0;
    squares += (l1 * l1 + l2) / 12.0;
    ++n;
  }
  ASSERT_EQ(n, 48);
  const double mean = sum / n;
  const double spread = std::sqrt(squares / n - mean * mean) / mean;
  // White noise keeps the share of its variance that the functions' number has in that of the
  // patches, a half: 0.71 of the deviation, known from 24 numbers to 15 %.
  EXPECT_NEAR(spread / light.median_relative_std, std::sqrt(0.5), 4.0 * 0.15 * std::sqrt(0.5));
  EXPECT_NEAR(light.audit.entered, 64.0, 1e-9);
  // l of a beam of 1/400 per mm^2, scattered once or more: above single scattering alone.
  const double single = std::numbers::pi / 1.69 * 2.0 * 0.25 / std::numbers::pi / 400.0 / 5.0;
  EXPECT_GT(mean, single);
  EXPECT_LT(mean, 10.0 * single);
}

}  // namespace
}  // namespace scattermeter
