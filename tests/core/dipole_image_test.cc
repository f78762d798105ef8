#include "core/dipole_image.h"

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "tests/core/half_lit_plate.h"

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
