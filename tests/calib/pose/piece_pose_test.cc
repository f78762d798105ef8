#include "calib/pose/piece_pose.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "tests/fixtures/calib/edge_scene.h"
#include "tests/fixtures/draws.h"

namespace scattermeter::calib {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
const Eigen::Vector3d kCenter(0, 0, 10);

// The cube of the rig, and pictures of it after a motion.
class PiecePoseStatistics : public ::testing::Test {
 protected:
  PiecePoseStatistics() : scene_(test_support::make_cube()) {
    lens_ = small_lens();
    lens_.width_px *= 2;
    lens_.height_px *= 2;
    lens_.fx_px = lens_.fy_px = 1.6 * lens_.fx_px;
    lens_.cx_px = 239.2;
    lens_.cy_px = 159.7;
    exact_.silhouette.line_std_px = 0.02;
  }

  // The piece from a camera that knows its pose to camera_std (rad; 100 times as many mm).
  PieceView view(const RayScene& piece, const Rigid3d& camera, const Rigid3d& moved,
                 double camera_std, std::mt19937_64* random) const {
    PieceView out;
    out.camera.status = PoseStatus::kOk;
    out.camera.covariance.setZero();
    out.camera.covariance.diagonal() << Eigen::Vector3d::Constant(camera_std * camera_std),
        Eigen::Vector3d::Constant(1e4 * camera_std * camera_std);
    std::normal_distribution<double> normal;
    Eigen::Vector3d turn, shift;
    for (double& v : turn) v = camera_std * normal(*random);
    for (double& v : shift) v = 100.0 * camera_std * normal(*random);
    const Eigen::AngleAxisd error(turn.norm(), turn.norm() > 0.0
                                                   ? Eigen::Vector3d(turn.normalized())
                                                   : Eigen::Vector3d::UnitZ());
    // Stated: the true pose without its error.
    out.camera.camera_from_world.rotation = error.inverse() * camera.rotation;
    out.camera.camera_from_world.translation_mm = camera.translation_mm - shift;
    out.shots = {{&scene_, 0, picture(piece, lens_, camera * moved, 1500, random)}};
    return out;
  }
  PieceView view(const Rigid3d& camera, const Rigid3d& moved, double camera_std,
                 std::mt19937_64* random) const {
    return view(scene_, camera, moved, camera_std, random);
  }

  // A piece that is off its mesh by as much as is stated, at every corner.
  RayScene drawn_piece(const Rigid3d& camera, std::mt19937_64* random) const {
    const double corner_std_mm =
        exact_.silhouette.line_std_px * (camera * kCenter).norm() / lens_.fx_px;
    std::normal_distribution<double> normal;
    TriangleMesh mesh = test_support::make_cube();
    for (Eigen::Vector3d& corner : mesh.vertices_mm) {
      for (double& v : corner) v += corner_std_mm * normal(*random);
    }
    return RayScene(mesh);
  }

  RayScene scene_;
  CameraIntrinsics lens_;
  PiecePoseOptions exact_;  // mesh and lens are exact
};

Rigid3d motion(const Eigen::Vector3d& shift_mm, const Eigen::Vector3d& turn_rad) {
  const Eigen::Quaterniond q(
      Eigen::AngleAxisd(turn_rad.norm(), Eigen::Vector3d(turn_rad.normalized())));
  return {q, kCenter + shift_mm - q * kCenter};
}

Eigen::Matrix<double, 6, 1> error_of(const PiecePose& found, const Rigid3d& truth) {
  const Eigen::AngleAxisd turn(truth.rotation * found.moved.rotation.conjugate());
  Eigen::Matrix<double, 6, 1> out;
  out << truth * kCenter - found.moved * kCenter, turn.angle() * turn.axis();
  return out;
}

// From 5 mm and 5 degrees off, in all draws, and each component scatters as it is stated to.
TEST_F(PiecePoseStatistics, IsFoundFromAfarAndKnowsItsScatter) {
  const int draws = test_support::draws(6, 200);
  std::mt19937_64 random(8);
  std::normal_distribution<double> normal;
  Eigen::VectorXd squares = Eigen::VectorXd::Zero(6);
  for (int i = 0; i < draws; ++i) {
    Eigen::Vector3d shift, turn;
    for (double& v : shift) v = normal(random);
    for (double& v : turn) v = normal(random);
    const Rigid3d truth = motion(5.0 * shift.normalized(), 5.0 * kDegree * turn.normalized());
    const RayScene piece = drawn_piece(cube_view(), &random);
    const PiecePose found =
        find_piece({view(piece, cube_view(), truth, 2e-4, &random)}, lens_, kCenter, exact_);
    ASSERT_EQ(found.problem, "") << i;
    const auto error = error_of(found, truth);
    const Eigen::VectorXd pull = error.cwiseQuotient(found.covariance.diagonal().cwiseSqrt());
    std::printf("%2d:", i);
    for (Eigen::Index k = 0; k < 6; ++k) std::printf(" %.2g (%.1f)", error[k], pull[k]);
    std::printf("\n");
    squares += pull.cwiseAbs2() / draws;
  }
  std::printf("rms of pulls: %.2f %.2f %.2f mm, %.2f %.2f %.2f rad\n", std::sqrt(squares[0]),
              std::sqrt(squares[1]), std::sqrt(squares[2]), std::sqrt(squares[3]),
              std::sqrt(squares[4]), std::sqrt(squares[5]));
  // 200 draws: 5 % of a deviation for each component, a third of that for all six.
  const double limit = test_support::limit_at(0.2, 200, draws);
  EXPECT_NEAR(std::sqrt(squares.mean()), 1.0, std::min(limit, 0.5));
  EXPECT_LT(std::sqrt(squares.maxCoeff()), 1.0 + limit);
  EXPECT_GT(std::sqrt(squares.minCoeff()), 1.0 - limit);
}

// On its plane, height and tilt are those of the plane; a mesh that is too large would need another
// height.
TEST_F(PiecePoseStatistics, StandsOnItsPlane) {
  std::mt19937_64 random(3);
  const Rigid3d truth = motion({3, -2, 0}, {0, 0, 6.0 * kDegree});
  const PieceView seen = view(cube_view(), truth, 0.0, &random);
  const PiecePose free = find_piece({seen}, lens_, kCenter, exact_);
  PiecePoseOptions on_plane = exact_;
  on_plane.is_on_plane = true;
  const PiecePose found = find_piece({seen}, lens_, kCenter, on_plane);
  ASSERT_EQ(found.problem, "");
  const auto error = error_of(found, truth);
  const Eigen::VectorXd std = found.covariance.diagonal().cwiseSqrt();
  for (Eigen::Index k = 0; k < 6; ++k) EXPECT_LT(std::abs(error[k]), 4.0 * std[k]) << k;
  EXPECT_LT(std[2], on_plane.plane_std_mm);
  EXPECT_LT(found.covariance.trace(), free.covariance.trace());
  // Seen from 30 degrees above, a piece that hangs in the air looks like one that stands farther
  // off.
  const PieceView lifted = view(cube_view(), motion({0, 0, 2}, {0, 0, 0.1}), 0.0, &random);
  const std::string problem = find_piece({lifted}, lens_, kCenter, on_plane).problem;
  EXPECT_NE(problem.find("too high"), std::string::npos) << problem;
}

// An unknown size leaves the distance from the camera unknown.
TEST_F(PiecePoseStatistics, AnUncertainSizeWidensTheDistance) {
  std::mt19937_64 random(4);
  const PieceView seen = view(cube_view(), motion({1, 0, 0}, {0, 0, 0.02}), 0.0, &random);
  PiecePoseOptions loose = exact_;
  loose.scale_relative_std = 0.01;
  const PiecePose a = find_piece({seen}, lens_, kCenter, exact_);
  const PiecePose b = find_piece({seen}, lens_, kCenter, loose);
  const Eigen::Matrix3d added = (b.covariance - a.covariance).topLeftCorner(3, 3);
  EXPECT_NEAR(added.trace(), 1.8 * 1.8, 0.05);
}

TEST_F(PiecePoseStatistics, AViewWithoutAnOutlineIsLeftOut) {
  std::mt19937_64 random(6);
  const Rigid3d truth = motion({1, 0, 0}, {0, 0, 0.02});
  const PieceView seen = view(cube_view(), truth, 1e-4, &random);
  PieceView dark = seen;
  for (float& v : dark.shots[0].samples.signal_counts) v = 1.0F;
  const PiecePose alone = find_piece({seen}, lens_, kCenter, exact_);
  const PiecePose both = find_piece({dark, seen}, lens_, kCenter, exact_);
  EXPECT_EQ(both.problem, "");
  EXPECT_EQ(both.off, alone.off);
  EXPECT_NE(find_piece({dark}, lens_, kCenter, exact_).problem, "");
}

// Two views are better than one, unless the piece was moved between them.
TEST_F(PiecePoseStatistics, ViewsAgree) {
  std::mt19937_64 random(5);
  const Rigid3d truth = motion({2, 1, 0}, {0, 0.01, 0.05});
  const Rigid3d other = camera_looking_at({0, 0, 10}, 190, 0.8, -0.4);
  const PieceView a = view(cube_view(), truth, 1e-4, &random);
  const PieceView b = view(other, truth, 1e-4, &random);
  const PiecePose one = find_piece({a}, lens_, kCenter, exact_);
  const PiecePose both = find_piece({a, b}, lens_, kCenter, exact_);
  ASSERT_EQ(both.problem, "");
  EXPECT_LT(both.covariance.trace(), one.covariance.trace());
  EXPECT_LT(error_of(both, truth).head<3>().norm(), 0.15);
  const PieceView moved = view(other, motion({3, 1, 0}, {0, 0.01, 0.05}), 1e-4, &random);
  EXPECT_NE(find_piece({a, moved}, lens_, kCenter, exact_).problem.find("was moved between"),
            std::string::npos);
  EXPECT_THROW(find_piece({}, lens_, kCenter), std::invalid_argument);
  // Nothing is seen.
  PieceView dark = a;
  std::fill(dark.shots[0].samples.signal_counts.begin(), dark.shots[0].samples.signal_counts.end(),
            0.0F);
  EXPECT_NE(find_piece({dark}, lens_, kCenter).problem, "");
}

}  // namespace
}  // namespace scattermeter::calib
