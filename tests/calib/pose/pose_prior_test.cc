#include "calib/pose/pose_prior.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calib/pose/edge_fit.h"

namespace scattermeter::calib {
namespace {

TEST(PosePrior, FreesThePoseAlone) {
  EXPECT_THAT(pose_parameters(), ::testing::ElementsAre(0, 1, 2, 3, 4, 5));
  EXPECT_EQ(pose_parameters().front(), edge_parameter::kPose);
  EXPECT_LT(pose_parameters().back(), edge_parameter::kTurn);
}

TEST(PosePrior, KnowsThePoseToAThirdAndNothingElse) {
  const Eigen::MatrixXd prior = loose_pose_prior(17, 200.0);
  ASSERT_EQ(prior.rows(), 17);
  for (int i = 0; i < 3; ++i) {
    EXPECT_DOUBLE_EQ(prior(i, i), 1 / 0.09);
    EXPECT_DOUBLE_EQ(prior(3 + i, 3 + i), 1 / 3600.0);
  }
  EXPECT_DOUBLE_EQ(prior.sum(), 3 / 0.09 + 3 / 3600.0);
}

}  // namespace
}  // namespace scattermeter::calib
