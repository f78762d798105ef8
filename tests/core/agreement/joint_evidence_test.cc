#include "core/agreement/joint_evidence.h"

#include <cmath>
#include <random>

#include <Eigen/Dense>
#include <gtest/gtest.h>

namespace scattermeter {
namespace {

const Nuisance kPosition{"LED position", 0.2, true, "led1.position0"};
const Nuisance kPose{"pose", 1.0, true, "pose0"};
const Nuisance kPower{"LED power", 0.01, true, "led1.power"};

// v = (b1 + b2) / (1 + a1 + a2), its variance if all statements hold (a1 + a2) / (1 + a1 + a2), and
// that of the true value 1 / (1 + a1 + a2).
TEST(JointEvidence, TwoChannelsInClosedForm) {
  const auto channel = [](double a, double b) {
    return RigEvidence{{kPosition},
                       Eigen::MatrixXd::Constant(1, 1, a),
                       Eigen::VectorXd::Constant(1, b),
                       Eigen::VectorXd::Constant(1, 0.01)};
  };
  const RigEvidence first = channel(4.0, 6.0), second = channel(5.0, 9.0);
  const std::vector<PriorPull> pulls = joint_pulls({&first, &second}).pulls;
  ASSERT_EQ(pulls.size(), 1U);
  EXPECT_EQ(pulls[0].name, "led1.position0");
  EXPECT_NEAR(pulls[0].pull, 1.5 / std::sqrt(0.9), 1e-12);
  EXPECT_NEAR(pulls[0].offset, 1.5 * 0.2, 1e-12);
  EXPECT_NEAR(pulls[0].std, 0.2 / std::sqrt(10.0), 1e-12);
  EXPECT_NEAR(pulls[0].image_relative, 1.5 * 0.01, 1e-12);
  EXPECT_TRUE(joint_pulls(std::vector<const RigEvidence*>{}).pulls.empty());
  // (b1 + b2)^2 / (a (1 + a)).
  EXPECT_NEAR(joint_pulls({&first, &second}).chi2, 225.0 / 90.0, 1e-12);
  EXPECT_EQ(joint_pulls({&first, &second}).dof, 1.0);
}

// The same as from all nuisances of both channels at once, where each has an own power.
TEST(JointEvidence, WhatIsNotSharedIsEliminated) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  const auto drawn = [&](Eigen::Index rows, Eigen::Index cols) {
    return Eigen::MatrixXd(
        Eigen::MatrixXd::NullaryExpr(rows, cols, [&](Eigen::Index) { return normal(random); }));
  };
  const Eigen::MatrixXd a = drawn(9, 3), b = drawn(7, 3);  // position, power, pose
  const Eigen::VectorXd r = drawn(9, 1), s = drawn(7, 1);
  const auto evidence = [](const Eigen::MatrixXd& j, const Eigen::VectorXd& rest) {
    return RigEvidence{{kPosition, kPower, kPose},
                       j.transpose() * j,
                       j.transpose() * rest,
                       Eigen::Vector3d::Ones()};
  };
  const RigEvidence first = evidence(a, r), second = evidence(b, s);
  const std::vector<PriorPull> pulls = joint_pulls({&first, &second}).pulls;
  ASSERT_EQ(pulls.size(), 2U);
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(16, 4);  // position, pose, power, power
  all.topRows(9) << a.col(0), a.col(2), a.col(1), Eigen::VectorXd::Zero(9);
  all.bottomRows(7) << b.col(0), b.col(2), Eigen::VectorXd::Zero(7), b.col(1);
  Eigen::VectorXd rest(16);
  rest << r, s;
  const Eigen::MatrixXd information = all.transpose() * all;
  const Eigen::MatrixXd posterior = (Eigen::Matrix4d::Identity() + information).inverse();
  const Eigen::VectorXd v = posterior * all.transpose() * rest;
  for (Eigen::Index k = 0; k < 2; ++k) {
    const double variance = 1.0 - posterior(k, k);
    EXPECT_NEAR(pulls[static_cast<std::size_t>(k)].pull, v[k] / std::sqrt(variance), 1e-9);
  }
  EXPECT_EQ(pulls[1].name, "pose0");
  const std::vector<PriorPull> own = own_pulls_beside(second, {&first, &second});
  ASSERT_EQ(own.size(), 1U);
  EXPECT_EQ(own[0].name, "led1.power");
  EXPECT_NEAR(own[0].pull, v[3] / std::sqrt(1.0 - posterior(3, 3)), 1e-9);
}

}  // namespace
}  // namespace scattermeter
