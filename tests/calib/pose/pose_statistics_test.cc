// What the pose states of its errors, through raws, with the camera at another place each time.
#include <array>
#include <cmath>
#include <cstdio>
#include <random>
#include <string>

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include "apps/rig/open_objects.h"
#include "apps/simulation/virtual_shots.h"
#include "calib/pose/shot_pose.h"
#include "core/camera/camera_model.h"
#include "core/view/camera_view.h"
#include "tests/fixtures/apps/charuco_rig.h"
#include "tests/fixtures/calib/pose_scenes.h"
#include "tests/fixtures/draws.h"

namespace scattermeter::apps {
namespace {

const int kDraws = test_support::draws(10, 50);
constexpr double kMarkStd_px = 0.15;

// Errors of (rotation in rad, translation in mm, both in camera axes) over the draws.
class PoseStatistics {
 public:
  explicit PoseStatistics(std::string name) : name_(std::move(name)) {}

  void add(const PoseResult& found, const Rigid3d& truth) {
    const Eigen::Matrix<double, 6, 1> error = calib::pose_error(found.camera_from_world, truth);
    const Eigen::Matrix<double, 6, 1> z =
        error.cwiseQuotient(found.covariance.diagonal().cwiseSqrt());
    n_ += 1;
    sum_ += z;
    squares_ += z.cwiseAbs2();
    mahalanobis_ += error.dot(found.covariance.ldlt().solve(error));
    center_mm_ += (inverse(found.camera_from_world).translation_mm - inverse(truth).translation_mm)
                      .squaredNorm();
    stated_mm_ += found.center_std_mm.squaredNorm();
  }

  // Every component unbiased and, like the whole, as uncertain as stated. Fifty draws know a
  // deviation to 10 %: single components are held to 3.5 of those, their mean to 20 %.
  void expect_truth() const {
    SCOPED_TRACE(name_);
    ASSERT_EQ(n_, kDraws);
    double log_ratio = 0;
    for (int k = 0; k < 6; ++k) {
      const double mean = sum_[k] / n_;
      const double ratio = 1 / std::sqrt((squares_[k] - n_ * mean * mean) / (n_ - 1));
      log_ratio += std::log(ratio) / 6;
      EXPECT_LT(std::abs(mean), 3.5 / ratio / std::sqrt(n_)) << k;
      EXPECT_NEAR(ratio, 1, test_support::limit_at(0.35, 50, kDraws)) << k;
      std::printf("%s %d: mean %+.2f stated deviations, predicted/sampled %.2f\n", name_.c_str(), k,
                  mean, ratio);
    }
    std::printf("%s: centre %.4f mm off (rms), %.4f stated; chi-square %.2f of 6; all %.2f\n",
                name_.c_str(), std::sqrt(center_mm_ / n_), std::sqrt(stated_mm_ / n_),
                mahalanobis_ / n_, std::exp(log_ratio));
    EXPECT_NEAR(std::exp(log_ratio), 1, test_support::limit_at(0.2, 50, kDraws));
  }

 private:
  std::string name_;
  double n_ = 0, mahalanobis_ = 0, center_mm_ = 0, stated_mm_ = 0;
  Eigen::Matrix<double, 6, 1> sum_ = Eigen::Matrix<double, 6, 1>::Zero(), squares_ = sum_;
};

TEST(PoseStatistics, BoardOutlineAndMarksAreUnbiasedAndKnowTheirScatter) {
  const CharucoRig files("PE_pyramid_1");
  Rig rig = read_rig(files.rig());
  rig.pose.options.point_std_px = 0.02;  // the board's corners scatter as their residuals tell
  const ObjectScenes scenes = open_objects(rig);
  const std::string& file = rig.scene.shots[0].file;
  PoseStatistics board("board"), board_outline("board and outline"), marks("marks"),
      marks_outline("marks and outline");
  for (int draw = 0; draw < kDraws; ++draw) {
    std::mt19937_64 random(static_cast<std::uint64_t>(draw) + 1);
    std::normal_distribution<double> normal;
    const auto point = [&](const Eigen::Vector3d& mean, double std) {
      return Eigen::Vector3d(mean.x() + std * normal(random), mean.y() + std * normal(random),
                             mean.z() + std * normal(random));
    };
    rig.truth.pose = CameraPlacement{point({0, -100, 150}, 4), point({0, 0, 9}, 1)};
    const Rigid3d truth =
        look_at(rig.truth.pose->position_mm, rig.truth.pose->look_at_mm, {0, 0, 1});
    // The body is as much off its mesh as the rig says: pose.edge_std_px, at every corner.
    const double corner_std_mm =
        rig.pose.edge_std_px * truth.translation_mm.norm() / rig.scene.camera.intrinsics.fx_px;
    const ObjectScenes true_scenes = open_objects(rig, [&](const SceneObject& object) {
      TriangleMesh mesh = scenes.at(object.name).mesh();
      for (Eigen::Vector3d& v : mesh.vertices_mm) v = point(v, corner_std_mm);
      return mesh;
    });
    const VirtualShots shots(rig, true_scenes, {.noise = true});
    const capture::RawFrame frame = shots.frame(0, static_cast<std::uint64_t>(draw) + 1);
    const PoseResult of_board = calib::pose_from_board(rig.scene, rig.pose, frame, file);
    board.add(of_board, truth);
    board_outline.add(
        calib::pose_from_silhouette(rig.scene, rig.pose, scenes, of_board, 0, frame, file), truth);
    // The same camera, by marks that were read off the image by hand.
    Rig by_hand = rig;
    by_hand.pose = {};
    by_hand.pose.options.point_std_px = kMarkStd_px;
    for (const Eigen::Vector3d& x : std::vector<Eigen::Vector3d>{{-26, -14, 0},
                                                                 {26, -14, 0},
                                                                 {26, 20, 0},
                                                                 {-26, 20, 0},
                                                                 {-28, -8, 12},
                                                                 {28, -8, 12},
                                                                 {-24, 16, 15},
                                                                 {24, 16, 15},
                                                                 {0, 19, 0},
                                                                 {0, -16, 0}}) {
      Eigen::Vector2d px = project(rig.scene.camera.intrinsics, truth, {x}).front();
      for (double& v : px) v += kMarkStd_px * normal(random);
      by_hand.pose.points.push_back({x, px});
    }
    const PoseResult of_marks = calib::pose_from_points(by_hand.scene, by_hand.pose);
    marks.add(of_marks, truth);
    marks_outline.add(
        calib::pose_from_silhouette(rig.scene, rig.pose, scenes, of_marks, 0, frame, file), truth);
  }
  for (const PoseStatistics* s : {&board, &board_outline, &marks, &marks_outline}) {
    s->expect_truth();
  }
}

}  // namespace
}  // namespace scattermeter::apps
