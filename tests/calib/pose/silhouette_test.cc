#include "calib/pose/silhouette.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include <gtest/gtest.h>

#include "tests/fixtures/calib/edge_scene.h"

namespace scattermeter::calib {
namespace {

class SilhouetteTest : public ::testing::Test {
 protected:
  SilhouetteTest() : scene_(test_support::make_cube()) {}

  std::vector<EdgeShot> shot(const Rigid3d& pose, double counts, std::uint64_t seed) const {
    std::mt19937_64 random(seed);
    return {{&scene_, 0, picture(scene_, small_lens(), pose, counts, &random)}};
  }

  RayScene scene_;
};

// A camera that was turned by a degree and moved is found, to hundredths of a pixel.
TEST_F(SilhouetteTest, IsFoundFromAfar) {
  const Rigid3d knock{
      Eigen::Quaterniond(Eigen::AngleAxisd(std::numbers::pi / 180, Eigen::Vector3d(0.6, 0.8, 0))),
      {0.2, 0.1, 1}};
  const Rigid3d truth = knock * cube_view();
  const Silhouette s = find_silhouette(shot(truth, 1000, 1), small_lens(), cube_view());
  ASSERT_EQ(s.status, SilhouetteStatus::kOk) << s.message;
  const Eigen::Matrix<double, 6, 1> e = pose_error(s.camera_from_world, truth);
  // About the world's origin, at the cube's foot: 620 px a radian at 180 mm, 3.4 px a mm.
  EXPECT_LT(e.segment<2>(3).norm(), 0.02);
  EXPECT_LT(std::abs(e[5]), 0.15);
  EXPECT_LT(e.head<3>().norm(), 2e-3);
  EXPECT_LT(s.line_std_px, 0.2);
}

TEST_F(SilhouetteTest, SaysWhatIsMissing) {
  const Silhouette dark = find_silhouette(shot(cube_view(), 0, 3), small_lens(), cube_view());
  EXPECT_EQ(dark.status, SilhouetteStatus::kNotFound);
  EXPECT_FALSE(dark.message.empty());
  EXPECT_THROW(find_silhouette({}, small_lens(), cube_view()), std::invalid_argument);
  SilhouetteOptions options;
  options.search = 0;
  EXPECT_THROW(options.Check(), std::invalid_argument);
}

TEST_F(SilhouetteTest, WindowHoldsTheSearch) {
  const PixelRect w = silhouette_window(scene_, small_lens(), cube_view(), {});
  EXPECT_EQ(w.x0 % 2, 0);
  EXPECT_LE(w.x0 + w.width, 240);
  EXPECT_GT(w.width, 100);
}

}  // namespace
}  // namespace scattermeter::calib
