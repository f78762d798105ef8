#include "core/diffusion/dipole_image.h"

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "core/light/lit_points.h"
#include "tests/fixtures/core/boxes.h"
#include "tests/fixtures/core/half_lit_plate.h"

namespace scattermeter {
namespace {

// The renderer against the closed-form arcs of the plate's image, on patches and materials that the
// estimator's tests do not use; the whole field, interpolated between nodes.
TEST(DipoleImage, FieldMeetsQuadrature) {
  const std::array<Medium, 3> media = {Medium{2.19, 0.002, 1.3}, Medium{0.9, 0.02, 1.3},
                                       Medium{1.5, 0.0, 1.3}};
  const test_support::HalfLitPlate rows(1.0);   // where the image is wanted
  const test_support::HalfLitPlate fine(0.45);  // patches of the rendering
  std::vector<bool> needed(static_cast<std::size_t>(fine.patches().size()), true);
  SurfaceField field(fine.patches(), needed);
  field.add(dipole_radiosity(field.nodes_mm(), fine.light(), {0, 0, -5}, 44.0, media,
                             Eigen::Array3d(1.0, 2.0, 3.0)));
  const RayScene scene(test_support::make_box({-15, -15, -10}, {15, 15, 0}));
  for (int c = 0; c < 3; ++c) {
    const Dipole dipole(media[static_cast<std::size_t>(c)]);
    const Eigen::VectorXd truth = (c + 1.0) * rows.image(dipole);
    double worst = 0.0;
    for (std::size_t j = 0; j < rows.rows().size(); j += 3) {
      const auto corner = rows.patches().corners_mm(rows.rows()[j]);
      const Eigen::Vector3d middle = (corner[0] + corner[1] + corner[2]) / 3.0;
      double mean = 0.0;
      // The same six points that the truth is the mean over.
      for (const auto& [a, w] : {std::pair{0.108103018168070, 0.223381589678011},
                                 std::pair{0.816847572980459, 0.109951743655322}}) {
        for (std::size_t i = 0; i < 3; ++i) {
          const Eigen::Vector3d p =
              a * corner[i] + 0.5 * (1.0 - a) * (corner[(i + 1) % 3] + corner[(i + 2) % 3]);
          const RayHit hit = scene.first_hit(p + Eigen::Vector3d(0, 0, 5), {0, 0, -1});
          mean += w * field.eval(fine.patches().locate(hit.facet_idx, hit.barycentric))[c];
        }
      }
      worst = std::max(worst, std::abs(mean - truth[static_cast<Eigen::Index>(j)]));
      EXPECT_TRUE(middle.allFinite());
    }
    // Quadratic elements of 0.45 mm on a shadow edge smoothed over z_r >= 0.46 mm.
    EXPECT_LT(worst, 1e-3 * truth.maxCoeff()) << "channel " << c;
  }
}

// A cube lit by an LED, against a far finer rule, for patches small and large for the mean free
// path: to 1e-4 of each sum, and the same where one channel is dark.
TEST(DipoleImage, SumsAreRightTo1e4) {
  const RayScene scene(test_support::make_cube());
  const PatchMesh patches(scene.mesh(), 1.2);
  Led led;
  led.position_mm = {30, -60, 80};
  led.axis = (Eigen::Vector3d(0, 0, 10) - led.position_mm).normalized();
  const IncidentLight light = illuminate(patches, scene, led, 1.3);
  std::vector<Eigen::Vector3d> points;
  for (int k = 0; k < patches.size(); k += 97) points.push_back(patches.center_mm(k));
  for (const double mfp_mm : {4.8, 2.4, 1.2}) {
    std::array<Medium, 3> media;
    for (std::size_t c = 0; c < 3; ++c) {
      const double albedo = 1.0 - 0.003 * static_cast<double>(c);
      media[c] = {albedo / mfp_mm, (1.0 - albedo) / mfp_mm, 1.3};
    }
    const Eigen::Array3d power(1.0, 0.0, 3.0);
    const auto l = dipole_radiosity(points, light, {0, 0, 10}, 40.0, media, power);
    const auto fine = lit_points(light, 0.4 * mfp_mm, 10'000'000);
    for (std::size_t j = 0; j < points.size(); ++j) {
      EXPECT_EQ(l[j][1], 0.0);
      for (const Eigen::Index c : {0, 2}) {
        const Dipole dipole(media[static_cast<std::size_t>(c)]);
        double truth = 0.0;
        for (std::size_t k = 0; k < fine->points_mm.size(); ++k) {
          truth += power[c] * fine->power_sr[k] *
                   dipole.reflectance_per_mm2((points[j] - fine->points_mm[k]).norm());
        }
        EXPECT_NEAR(l[j][c], truth, 1e-4 * truth) << mfp_mm;
      }
    }
  }
}

// A mean free path of a thousandth of the patches' size: what leaves is the albedo times what
// enters there, in the middle of an even light.
TEST(DipoleImage, MaterialFarDenserThanThePatches) {
  const PatchMesh patches(test_support::make_cube(), 2.0);
  IncidentLight light;
  for (int k = 0; k < patches.size(); ++k) {
    if (patches.normal(k).z() > 0.5) light.lit.push_back({patches.corners_mm(k), {2, 2, 2}, k});
  }
  const Medium dense{400.0, 100.0, 1.3};
  const auto l = dipole_radiosity({{0.3, 0.2, 20.0}}, light, {0, 0, 10}, 40.0,
                                  {dense, dense, dense}, Eigen::Array3d(1.0, 2.0, 3.0));
  const double truth = 2.0 * Dipole(dense).total_reflectance();
  for (Eigen::Index c = 0; c < 3; ++c) {
    EXPECT_NEAR(l[0][c], (static_cast<double>(c) + 1.0) * truth, 1e-3 * truth);
  }
}

TEST(DipoleImage, UnneededPatchesStayUndefined) {
  const PatchMesh patches(test_support::make_cube(), 5.0);
  std::vector<bool> needed(static_cast<std::size_t>(patches.size()), false);
  needed[0] = true;
  const SurfaceField field(patches, needed);
  EXPECT_EQ(field.nodes_mm().size(), 6U);
  EXPECT_EQ(field.eval({0, {1, 0, 0}})[0], 0.0);
  EXPECT_TRUE(std::isnan(field.eval({1, {1, 0, 0}})[0]));
}

TEST(DipoleImage, PatchSizeFollowsTheMeanFreePath) {
  const std::array<Medium, 3> media = {Medium{4.0, 0, 1.3}, Medium{1.0, 0, 1.3},
                                       Medium{0.1, 0, 1.3}};
  EXPECT_DOUBLE_EQ(render_patch_size_mm(media, 20.0), 0.1125);
  EXPECT_DOUBLE_EQ(render_patch_size_mm(media, 4.0), 0.1);
  EXPECT_DOUBLE_EQ(render_patch_size_mm(media, 80.0), 80.0 / 250.0);
}

}  // namespace
}  // namespace scattermeter
