#include "calib/pose/lens_reaction.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/camera/lens.h"
#include "tests/fixtures/calib/edge_scene.h"
#include "tests/fixtures/calib/pose_scenes.h"

namespace scattermeter::calib {
namespace {

// Steps that move the image by about a tenth of a pixel.
LensParameters steps_of(const CameraIntrinsics& k) {
  LensParameters steps = LensParameters::Constant(1e-4);
  steps.head<4>() << 1e-4 * k.fx_px, 1e-4 * k.fy_px, 0.1, 0.1;
  return steps;
}

CameraIntrinsics changed(const CameraIntrinsics& k, Eigen::Index parameter, double by) {
  LensParameters lens = lens_parameters(k);
  lens[parameter] += by;
  return intrinsics_of(lens, k.width_px, k.height_px);
}

TEST(LensReaction, RayOfAPixelByDifferences) {
  const CameraIntrinsics k = wide_lens();
  const LensParameters steps = steps_of(k);
  for (const Eigen::Vector2d& ray : {Eigen::Vector2d(0.1, -0.2), Eigen::Vector2d(-0.4, 0.25)}) {
    const Eigen::Vector2d pixel = Lens(k).project(ray.homogeneous());
    const auto by_lens = ray_per_lens_parameter(k, ray);
    for (Eigen::Index p = 0; p < kLensParameters; ++p) {
      const Eigen::Vector2d numeric = (Lens(changed(k, p, steps[p])).unproject(pixel) -
                                       Lens(changed(k, p, -steps[p])).unproject(pixel)) /
                                      (2 * steps[p]);
      EXPECT_LT((by_lens.col(p) - numeric).norm(), 1e-5 * numeric.norm() + 1e-12)
          << "parameter " << p << ": " << by_lens.col(p).transpose() << " and "
          << numeric.transpose();
    }
  }
}

// The pose fitted anew through another lens, to the same points of the image.
TEST(LensReaction, PoseOfPointsByDifferences) {
  for (const CameraIntrinsics& k : {long_lens(), wide_lens()}) {
    std::mt19937_64 random(5);
    const Rigid3d pose = camera_looking_at({0, 0, 0}, 180, 0.7, 2);
    std::vector<PointPair> pairs = shot(k, pose, cube_points(20), 0, &random);
    // One outlier, which has no say in either.
    pairs.back().image_px += Eigen::Vector2d(300, -200);
    const PoseResult result = estimate_pose(k, pairs);
    ASSERT_EQ(result.status, PoseStatus::kOk) << result.message;
    const LensParameters steps = steps_of(k);
    for (Eigen::Index p = 0; p < kLensParameters; ++p) {
      const PoseResult up = estimate_pose(changed(k, p, steps[p]), pairs);
      const PoseResult down = estimate_pose(changed(k, p, -steps[p]), pairs);
      const Eigen::Matrix<double, 6, 1> numeric =
          pose_error(down.camera_from_world, up.camera_from_world) / (2 * steps[p]);
      EXPECT_LT((result.per_lens_parameter.col(p) - numeric).norm(), 1e-3 * numeric.norm() + 1e-9)
          << "parameter " << p << ":\n"
          << result.per_lens_parameter.col(p).transpose() << "\n"
          << numeric.transpose();
    }
  }
}

// A pose that is far better known than the silhouette reacts as if alone; one far worse leaves it
// to the silhouette, which a focal length df longer puts df / f of the distance farther away.
TEST(LensReaction, SilhouetteAndPointsByTheirWeight) {
  const RayScene scene(test_support::make_cube());
  std::mt19937_64 random(2);
  const EdgeShot shot{&scene, 0, picture(scene, small_lens(), cube_view(), 1000, &random)};
  const Silhouette s = find_silhouette({shot}, small_lens(), cube_view());
  ASSERT_EQ(s.status, SilhouetteStatus::kOk) << s.message;
  PoseResult prior;
  prior.status = PoseStatus::kOk;
  prior.camera_from_world = cube_view();
  prior.per_lens_parameter.setRandom();
  prior.per_lens_parameter *= 1e-3;
  LensParameters steps = LensParameters::Zero();
  const double f = small_lens().fx_px;
  steps[0] = 1e-3 * f;
  steps[4] = 1e-3;
  const auto with_std = [&](double std) {
    prior.covariance.setZero();
    prior.covariance.diagonal().head<3>().setConstant(std::pow(0.01 * std, 2));
    prior.covariance.diagonal().tail<3>().setConstant(std * std);
    return combined_per_lens_parameter(s, small_lens(), prior, steps);
  };
  const PosePerLens tight = with_std(1e-5);
  EXPECT_LT((tight.col(0) - prior.per_lens_parameter.col(0)).norm(),
            0.01 * prior.per_lens_parameter.col(0).norm());
  EXPECT_LT((tight.col(4) - prior.per_lens_parameter.col(4)).norm(),
            0.01 * prior.per_lens_parameter.col(4).norm());
  EXPECT_TRUE(tight.col(1).isZero(0.0));  // no step
  steps[1] = steps[0];
  const PosePerLens loose = with_std(100.0);
  // fx and fy together.
  const double away_mm = (loose(5, 0) + loose(5, 1)) * f;
  EXPECT_NEAR(away_mm / cube_view().translation_mm.z(), 1.0, 0.05);
}

}  // namespace
}  // namespace scattermeter::calib
