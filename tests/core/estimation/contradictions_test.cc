#include "core/estimation/contradictions.h"

#include <cmath>

#include <Eigen/Dense>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scattermeter {
namespace {

using ::testing::HasSubstr;

const Nuisance kDoubtedPosition{"LED position", 0.2, true, "led1.position0"};
const Nuisance kDoubtedPower{"LED power", 0.01, true, "led1.power"};

// R, G, B of one material and R of another, fitted.
std::vector<ChannelResult> three_channels_and_one() {
  std::vector<ChannelResult> results(4);
  for (std::size_t i = 0; i < 4; ++i) {
    results[i].material = i < 3 ? "PE" : "POM";
    results[i].channel = "RGBR"[i];
    results[i].estimate.converged = true;
  }
  return results;
}

// G's image is off by its power or by the position of the LED: no contradiction, unless R tells
// that the LED stands where it is stated to.
TEST(Contradictions, RefusesTheChannelThatNeedsAnotherPosition) {
  std::vector<ChannelResult> results = three_channels_and_one();
  results.resize(2);
  const auto take = [](const Eigen::Matrix2d& by, const Eigen::Vector2d& rest, ChannelResult& r) {
    r.evidence = {{kDoubtedPosition, kDoubtedPower},
                  by.transpose() * by,
                  by.transpose() * rest,
                  Eigen::Vector2d(0.05, 0.005)};
  };
  const Eigen::Matrix2d both_look_alike = (Eigen::Matrix2d() << 40, 20, 0, 0).finished();
  const Eigen::Vector2d off(90, 0);
  take(both_look_alike, off, results[1]);
  take(Eigen::Vector2d(0.1, 40.0).asDiagonal(), {0, 0}, results[0]);
  refuse_contradicted(results);
  EXPECT_TRUE(results[1].estimate.reasons.empty());
  take(Eigen::Vector2d(400.0, 40.0).asDiagonal(), {0, 0}, results[0]);
  refuse_contradicted(results);
  EXPECT_TRUE(results[0].estimate.reasons.empty());
  ASSERT_EQ(results[1].estimate.reasons.size(), 1U);
  EXPECT_THAT(results[1].estimate.reasons[0],
              HasSubstr("in view of the other channels: the shots contradict the LED power"));
}

// What one channel shows of the LED's position from 40 deviations on, all together show from
// 4 / sqrt(99 / 100) on; its power is its own.
TEST(Contradictions, OtherChannelsSeeWhatOneDoesNot) {
  std::vector<ChannelResult> results = three_channels_and_one();
  results.resize(2);
  for (std::size_t i = 0; i < 2; ++i) {
    results[i].evidence = {{kDoubtedPosition, kDoubtedPower},
                           Eigen::Vector2d(i == 0 ? 0.01 : 98.99, 0.01).asDiagonal(),
                           Eigen::Vector2d::Zero(),
                           Eigen::Vector2d(0.05, 0.005)};
    for (const Nuisance& n : results[i].evidence.nuisances) {
      PriorPull& pull = results[i].estimate.pulls.emplace_back(PriorPull{n.name, n.group});
      pull.least_seen_in_std = 40.0;
      pull.unseen_sigma_s_prime_per_mm = 1.0;
    }
  }
  refuse_contradicted(results);
  const std::vector<PriorPull>& pulls = results[0].estimate.pulls;
  EXPECT_NEAR(pulls[0].least_seen_in_std, 4.0 / std::sqrt(0.99), 1e-9);
  EXPECT_NEAR(pulls[0].unseen_sigma_s_prime_per_mm, 0.1 / std::sqrt(0.99), 1e-9);
  EXPECT_EQ(pulls[1].least_seen_in_std, 40.0);
}

// A channel whose model misses its image says nothing beside one whose model explains it, and what
// is most probable without.
TEST(Contradictions, MostProbableWhereNothingIsExplained) {
  std::vector<ChannelResult> results = three_channels_and_one();
  for (std::size_t i = 0; i < 4; ++i) {
    results[i].evidence = {{kDoubtedPosition},
                           Eigen::MatrixXd::Constant(1, 1, 9.0),
                           Eigen::VectorXd::Constant(1, i == 0 ? 10.0 : 20.0),
                           Eigen::VectorXd::Constant(1, 0.01)};
  }
  const auto miss = [](ChannelResult& r) {
    r.estimate.misfit_p_value = 0.0;
    r.estimate.misfit_relative = 0.01;
  };
  for (std::size_t i = 1; i < 4; ++i) miss(results[i]);
  ASSERT_EQ(most_probable_pulls_of(results).pulls.size(), 1U);
  EXPECT_NEAR(most_probable_pulls_of(results).pulls[0].offset, 1.0 * 0.2, 1e-12);
  miss(results[0]);
  EXPECT_NEAR(most_probable_pulls_of(results).pulls[0].offset, 70.0 / 37.0 * 0.2, 1e-12);
  EXPECT_TRUE(joint_pulls_of(results).pulls.empty());
}

// An offset of 3.5 deviations is no reason, one of 5.3 is: channels that see the quantity are
// refused, one that does not see it is not.
TEST(Contradictions, RefusesWhatAllContradict) {
  constexpr double kInformation = 400.0;
  std::vector<ChannelResult> results(4);
  for (ChannelResult& r : results) {
    r.estimate.converged = true;
    r.evidence = {{kDoubtedPosition},
                  Eigen::MatrixXd::Constant(1, 1, kInformation),
                  Eigen::VectorXd::Constant(1, 3.5 * kInformation),
                  Eigen::VectorXd::Constant(1, 0.005)};
  }
  results[3].evidence.image_relative[0] = 1e-5;
  refuse_contradicted(results);
  for (const ChannelResult& r : results) EXPECT_TRUE(r.estimate.reasons.empty());
  for (ChannelResult& r : results) r.evidence.score *= 1.5;
  refuse_contradicted(results);
  for (std::size_t i = 0; i < 3; ++i) {
    ASSERT_EQ(results[i].estimate.reasons.size(), 1U);
    EXPECT_THAT(results[i].estimate.reasons[0],
                HasSubstr("all channels together: the shots contradict the LED position"));
  }
  EXPECT_TRUE(results[3].estimate.reasons.empty());
}

TEST(Contradictions, ChannelsOfAMaterialShareTheirRig) {
  std::vector<ChannelResult> results = three_channels_and_one();
  results[1].estimate.pulls = {{"even light a.dng", "even light", 6.0, 1.0, 0.01}};
  results[1].estimate.reasons = {"its own"};
  refuse_contradicted(results);
  for (const std::size_t i : {0U, 2U}) {
    ASSERT_EQ(results[i].estimate.reasons.size(), 1U);
    EXPECT_THAT(results[i].estimate.reasons[0],
                HasSubstr("channel G of these shots: the shots contradict the even light"));
  }
  EXPECT_EQ(results[1].estimate.reasons.size(), 1U);
  EXPECT_TRUE(results[3].estimate.reasons.empty());
  // The dipole's failure in one channel is not that of the rig, unless another one fails as well.
  results[0].estimate.reasons.clear();
  results[1].estimate.misfit_p_value = 1e-9;
  results[1].estimate.misfit_relative = 0.02;
  refuse_contradicted(results);
  EXPECT_TRUE(results[0].estimate.reasons.empty());
  results[2].estimate = results[1].estimate;
  refuse_contradicted(results);
  ASSERT_FALSE(results[0].estimate.reasons.empty());
}

// Nine quantities off by 3 deviations each are none of them a contradiction, but all together are.
TEST(Contradictions, ManyQuantitiesAtOnce) {
  constexpr double kInformation = 1e4;
  std::vector<ChannelResult> results(1);
  results[0].estimate.converged = true;
  RigEvidence& e = results[0].evidence;
  for (int k = 0; k < 9; ++k) {
    e.nuisances.push_back({"LED position", 0.2, true, "led1.position" + std::to_string(k)});
  }
  e.information = kInformation * Eigen::MatrixXd::Identity(9, 9);
  e.image_relative = Eigen::VectorXd::Constant(9, 0.005);
  e.score = Eigen::VectorXd::Constant(9, 1.8 * kInformation);
  refuse_contradicted(results);
  EXPECT_TRUE(results[0].estimate.reasons.empty());  // 29 of 9
  e.score *= 3.0 / 1.8;
  refuse_contradicted(results);
  ASSERT_EQ(results[0].estimate.reasons.size(), 1U);  // 81 of 9
  EXPECT_THAT(results[0].estimate.reasons[0],
              HasSubstr("contradict what the rig states (chi-square 81 of 9 quantities)"));
}

// Three pulls of 3.7, each the larger of two shots, are as improbable together as one of 5.4.
TEST(Contradictions, StrayLightOfAllChannelsAddsUp) {
  std::vector<ChannelResult> results = three_channels_and_one();
  for (std::size_t i = 0; i < 4; ++i) {
    results[i].estimate.pulls = {{"even light a.dng", "even light", 2.7, 1.0, 0.01},
                                 {"even light b.dng", "even light", -1.0, 1.0, 0.01},
                                 {"eta", "eta", 3.9, 1.0, 0.01}};
  }
  refuse_contradicted(results);
  for (const ChannelResult& r : results) EXPECT_TRUE(r.estimate.reasons.empty());
  for (ChannelResult& r : results) r.estimate.pulls[0].pull = 3.7;
  results[2].estimate.pulls[0].image_relative = 1e-4;
  refuse_contradicted(results);
  for (const std::size_t i : {0U, 1U}) {
    ASSERT_EQ(results[i].estimate.reasons.size(), 1U);
    EXPECT_THAT(results[i].estimate.reasons[0],
                HasSubstr("all channels together: the shots contradict the even light"));
  }
  EXPECT_TRUE(results[2].estimate.reasons.empty());
  EXPECT_TRUE(results[3].estimate.reasons.empty());
}

// The scale of three channels, 3 deviations off in each: probably one cause, refused in all
// channels of the material, but not in those of another, whose image says nothing.
TEST(Contradictions, ChannelsOfAMaterialShareTheirScale) {
  std::vector<ChannelResult> results = three_channels_and_one();
  const Nuisance scale{"scale", 0.02, true, "scale"};
  EXPECT_FALSE(is_shared(scale));
  EXPECT_TRUE(is_shared_by_material(scale));
  for (std::size_t i = 0; i < 4; ++i) {
    const double information = i < 3 ? 1.0 : 0.0;
    results[i].evidence = {{scale},
                           Eigen::MatrixXd::Constant(1, 1, information),
                           Eigen::VectorXd::Constant(1, 3.0 * std::sqrt(2.0) * information),
                           Eigen::VectorXd::Constant(1, 0.02)};
  }
  EXPECT_TRUE(joint_pulls_of(results).pulls.empty());
  // (3 x 3 sqrt(2)) / (1 + 3) over the root of 3 / 4.
  const std::vector<PriorPull> pulls = joint_pulls_of(results, "PE").pulls;
  ASSERT_EQ(pulls.size(), 1U);
  EXPECT_NEAR(pulls[0].pull, 9.0 * std::sqrt(2.0) / 4.0 / std::sqrt(0.75), 1e-12);
  results[2].evidence.score *= 2.0;
  refuse_contradicted(results);
  for (std::size_t i = 0; i < 3; ++i) {
    ASSERT_EQ(results[i].estimate.reasons.size(), 1U);
    EXPECT_THAT(results[i].estimate.reasons[0],
                HasSubstr("all channels together: the shots contradict the scale"));
  }
  EXPECT_TRUE(results[3].estimate.reasons.empty());
}

TEST(Contradictions, TwoChannelsThatAreMissedRefuseTheThird) {
  std::vector<ChannelResult> results = three_channels_and_one();
  const auto miss = [&](std::size_t i) {
    results[i].estimate.misfit_p_value = 1e-9;
    results[i].estimate.misfit_relative = 0.02;
    results[i].estimate.reasons = {"the dipole misses the image"};
  };
  miss(0);
  miss(3);
  refuse_contradicted(results);
  EXPECT_TRUE(results[1].estimate.reasons.empty());
  miss(2);
  refuse_contradicted(results);
  ASSERT_EQ(results[1].estimate.reasons.size(), 1U);
  EXPECT_EQ(results[1].estimate.reasons[0],
            "channel R of these shots: the dipole misses the image");
  // A channel of which nothing was found has what the others say before its own.
  results[1].estimate.converged = false;
  results[1].estimate.sigma_s_prime_per_mm.value = 0.0;
  results[1].estimate.reasons = {"a.dng: channel G is dark"};
  refuse_contradicted(results);
  EXPECT_EQ(results[1].estimate.reasons.size(), 1U);
  results[1].estimate.sigma_s_prime_per_mm.value = 900.0;
  results[1].estimate.reasons = {"the fit did not converge"};
  refuse_contradicted(results);
  ASSERT_EQ(results[1].estimate.reasons.size(), 2U);
  EXPECT_EQ(results[1].estimate.reasons[0],
            "channel R of these shots: the dipole misses the image");
}

// A channel that misses its image and contradicts the rig casts doubt on those that nearly do.
TEST(Contradictions, AMissedChannelRefusesThoseInDoubt) {
  std::vector<ChannelResult> results = three_channels_and_one();
  const auto pull = [&](std::size_t i, double size) {
    PriorPull& p = results[i].estimate.pulls.emplace_back(PriorPull{"led1.power", "LED power"});
    p.pull = size;
    p.image_relative = p.explained_relative = 0.01;
  };
  pull(0, 5.0);
  pull(1, 2.9);
  pull(2, -3.1);
  pull(3, 3.1);
  results[0].estimate.misfit_p_value = 1e-9;
  results[0].estimate.misfit_relative = 0.02;
  results[0].estimate.reasons = {"the dipole misses the image"};
  refuse_contradicted(results);
  EXPECT_TRUE(results[1].estimate.reasons.empty());
  ASSERT_EQ(results[2].estimate.reasons.size(), 1U);
  EXPECT_THAT(results[2].estimate.reasons[0],
              HasSubstr("channel R of these shots: the shots contradict the LED power"));
  EXPECT_TRUE(results[3].estimate.reasons.empty());  // another material
}

// A model that misses the image says nothing about the rig.
TEST(Contradictions, ChannelsThatTheModelMissesDoNotCount) {
  std::vector<ChannelResult> results(1);
  results[0].estimate.converged = true;
  results[0].estimate.misfit_p_value = 1e-9;
  results[0].estimate.misfit_relative = 0.02;
  results[0].evidence = {{kDoubtedPosition},
                         Eigen::MatrixXd::Constant(1, 1, 1e4),
                         Eigen::VectorXd::Constant(1, 1e5),
                         Eigen::VectorXd::Ones(1)};
  EXPECT_TRUE(joint_pulls_of(results).pulls.empty());
}

}  // namespace
}  // namespace scattermeter
