#include "calib/pose/outline_model.h"

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include <gtest/gtest.h>

#include "core/base/cross_matrix.h"
#include "core/mesh/bodies.h"
#include "tests/fixtures/calib/painted_body.h"

namespace scattermeter::calib {
namespace {

// The offsets that a change of the rig causes, computed by projecting changed points.
class OutlineModelTest : public ::testing::Test {
 protected:
  OutlineModelTest() {
    pose_.camera_from_world = outline_view();
    pose_.covariance = 1e-12 * Eigen::Matrix<double, 6, 6>::Identity();
    contour_ = contour_points(scene_, lens_, pose_.camera_from_world, 2);
  }

  template <class Change>
  OutlineShot shot(const Change& change, double noise_px = 0.05) const {
    std::mt19937_64 random(7);
    std::normal_distribution<double> normal;
    OutlineShot out{"a.dng", 0, &contour_, {}, Eigen::Vector3d::Zero()};
    out.look.cell_px = 2;
    out.look.points = contour_.size();
    for (std::size_t i = 0; i < contour_.size(); ++i) {
      const ContourPoint& p = contour_[i];
      const Eigen::Vector3d moved = change(p.point_mm);
      const Eigen::Vector2d px = project(lens_, pose_.camera_from_world, {moved}).front();
      out.look.offsets.push_back({i, p.outward.dot(px - p.at_px) + noise_px * normal(random)});
    }
    return out;
  }
  // The value of some columns, all others fixed.
  Eigen::VectorXd fitted(const OutlineModel& model, Eigen::Index first, Eigen::Index n) const {
    Eigen::VectorXd std = Eigen::VectorXd::Zero(model.columns());
    std.segment(first, n).setConstant(100.0);
    return model.fit(std, false).value.segment(first, n);
  }

  RayScene scene_{cube_mesh()};
  CameraIntrinsics lens_ = outline_lens();
  PoseResult pose_;
  std::vector<ContourPoint> contour_;
  std::vector<Eigen::Vector3d> centers_{{0, 0, 10}};
};

TEST_F(OutlineModelTest, EachCause) {
  const Eigen::Vector3d d(0.1, -0.2, 0.15);
  const OutlineShot placed = shot([&](const Eigen::Vector3d& x) { return (x + d).eval(); });
  const OutlineModel of_place({placed}, lens_, pose_, centers_);
  EXPECT_LT((fitted(of_place, of_place.place(0), 3) - d).norm(), 0.02);

  const Eigen::Vector3d w(0.004, -0.006, 0.008);
  const OutlineShot turned =
      shot([&](const Eigen::Vector3d& x) { return (x + w.cross(x - centers_[0])).eval(); });
  const OutlineModel of_turn({turned}, lens_, pose_, centers_);
  EXPECT_LT((fitted(of_turn, of_turn.turn(0), 3) - w).norm(), 0.001);

  const OutlineShot scaled = shot(
      [&](const Eigen::Vector3d& x) { return (centers_[0] + 1.01 * (x - centers_[0])).eval(); });
  const OutlineModel of_scale({scaled}, lens_, pose_, centers_);
  EXPECT_NEAR(fitted(of_scale, of_scale.scale(0), 1)[0], 0.01, 0.001);

  // A shift of the world's origin seen by the camera is that of the pose.
  const OutlineModel of_pose({placed}, lens_, pose_, centers_);
  const Eigen::VectorXd dt = fitted(of_pose, 3, 3);
  EXPECT_LT((dt - pose_.camera_from_world.rotation * d).norm(), 0.02);
}

// A look about an assumed place measures from there, and tells the same place.
TEST_F(OutlineModelTest, AboutAnAssumedPlace) {
  const Eigen::Vector3d d(3, -2, 1);
  OutlineShot second = shot([&](const Eigen::Vector3d& x) { return x; });
  const Rigid3d moved = pose_.camera_from_world * Rigid3d{Eigen::Quaterniond::Identity(), d};
  const auto contour = contour_points(scene_, lens_, moved, 2);
  second.contour = &contour;
  second.assumed_mm = d;
  second.look.offsets.clear();
  for (std::size_t i = 0; i < contour.size(); ++i) second.look.offsets.push_back({i, 0.0});
  const OutlineModel model({second}, lens_, pose_, centers_);
  EXPECT_LT((fitted(model, model.place(0), 3) - d).norm(), 1e-6);
}

TEST_F(OutlineModelTest, OutliersAreLeftOut) {
  OutlineShot a = shot([&](const Eigen::Vector3d& x) { return x; });
  const std::size_t n = a.look.offsets.size();
  for (std::size_t i = 0; i < n; i += 5) a.look.offsets[i].px += 12.0;
  const OutlineModel model({a}, lens_, pose_, centers_);
  EXPECT_NEAR(static_cast<double>(model.kept(0)), 0.8 * static_cast<double>(n), 2.0);
  EXPECT_LT(fitted(model, model.place(0), 3).norm(), 0.03);
}

// A body that stands elsewhere is seen all the same; one of another shape is not.
TEST_F(OutlineModelTest, ShareOnPlace) {
  const OutlineShot moved =
      shot([](const Eigen::Vector3d& x) { return (x + Eigen::Vector3d(1, 0, 0)).eval(); });
  EXPECT_GT(OutlineModel({moved}, lens_, pose_, centers_).share_on_place(0, 2.0), 0.99);
  const OutlineShot bent = shot([](const Eigen::Vector3d& x) {
    return Eigen::Vector3d(x.x() * (1.0 + 0.05 * x.z()), x.y(), x.z());
  });
  EXPECT_LT(OutlineModel({bent}, lens_, pose_, centers_).share_on_place(0, 2.0), 0.7);
}

// Priors: a stated std holds a column back; the pose's own covariance counts.
TEST_F(OutlineModelTest, Priors) {
  const Eigen::Vector3d d(0.3, 0, 0);
  const OutlineModel model({shot([&](const Eigen::Vector3d& x) { return (x + d).eval(); })}, lens_,
                           pose_, centers_);
  Eigen::VectorXd std = Eigen::VectorXd::Zero(model.columns());
  const double nothing = model.fit(std, false).chi2;
  EXPECT_NEAR(model.fit(std, true).chi2, nothing, 0.02 * nothing);  // known to a micrometre
  std.segment<3>(model.place(0)).setConstant(0.1);
  const OutlineModel::Fit held = model.fit(std, false);
  EXPECT_NEAR(held.chi2, 9.0, 3.0);  // three deviations of the prior, and the points' noise
  EXPECT_LT(held.value[model.place(0)], 0.3);
  EXPECT_THROW(OutlineModel({}, lens_, pose_, centers_), std::invalid_argument);
}

}  // namespace
}  // namespace scattermeter::calib
