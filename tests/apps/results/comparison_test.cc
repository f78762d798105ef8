#include "apps/results/comparison.h"

#include <cmath>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/input_error.h"

namespace scattermeter::apps {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Pair;
using ::testing::ThrowsMessage;

ReadChannel channel(const std::string& material, char letter, double sigma_s_prime,
                    double sigma_a) {
  ReadChannel out;
  out.material = material;
  out.channel = letter;
  out.sigma_s_prime_per_mm.value = sigma_s_prime;
  out.sigma_s_prime_per_mm.std = 0.03;
  out.sigma_a_per_mm.value = sigma_a;
  out.sigma_a_per_mm.std = 5e-4;
  out.budget = {{"noise", 0.01, 3e-4}, {"scale", 0.02, 3e-4}, {"eta", 0.02, 2e-4}};
  out.responses = {{"scale", "scale", {0.02, 3e-4}},
                   {"pose a.dng0", "pose", {0.01, 1e-4}},
                   {"eta", "eta", {0.02, 2e-4}}};
  return out;
}

ReadResult result(const std::vector<ReadChannel>& channels, const std::string& path = "a.json") {
  ReadResult out;
  out.path = path;
  out.channels = channels;
  return out;
}

// 2 (0.03^2), less twice 0.02^2 of the scale that one rig has in both; eta is each material's own,
// and the pose each shot's.
TEST(Comparison, SharedCausesCountOnce) {
  const ReadChannel a = channel("PP", 'G', 1.0, 0.004), b = channel("PP", 'G', 1.05, 0.003);
  const ChannelComparison apart = compare(a, b, false), together = compare(a, b, true);
  EXPECT_NEAR(apart.sigma_s_prime_per_mm.value, 0.05, 1e-12);
  EXPECT_NEAR(apart.sigma_s_prime_per_mm.std, std::sqrt(18e-4), 1e-12);
  EXPECT_NEAR(together.sigma_s_prime_per_mm.std, std::sqrt(10e-4), 1e-12);
  EXPECT_NEAR(together.sigma_a_per_mm.value, -0.001, 1e-12);
  EXPECT_NEAR(together.sigma_a_per_mm.std, std::sqrt(2 * 25e-8 - 2 * 9e-8), 1e-12);
  // Without correlation the chi-square of two is exponential.
  EXPECT_NEAR(apart.p_value, std::exp(-0.5 * (25e-4 / 18e-4 + 1e-6 / 50e-8)), 1e-12);
}

// Results of one material under one rig: the errors of scale, LED, noise and eta are drawn. They
// shift both coefficients, so that these are correlated; and the lines of the budget, by what the
// variance falls if a cause were known, are larger than the shifts.
TEST(Comparison, EqualMaterialsAreRarelyTold) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  constexpr int kDraws = 20000;
  const std::vector<RigResponse> responses = {{"scale", "scale", {0.02, -3e-4}},
                                              {"led1.position0", "LED position", {0.01, 2e-4}},
                                              {"eta", "eta", {0.02, 2e-4}}};
  const Eigen::Vector2d noise(0.01, 3e-4);
  Eigen::Matrix2d covariance = noise.cwiseAbs2().asDiagonal();
  for (const RigResponse& r : responses) {
    covariance += r.shift_per_mm * r.shift_per_mm.transpose();
  }
  int told = 0, told_apart = 0;
  for (int i = 0; i < kDraws; ++i) {
    const double scale = normal(random), led = normal(random);
    const auto drawn = [&] {
      const Eigen::Vector2d at =
          Eigen::Vector2d(1.0 + noise[0] * normal(random), 0.004 + noise[1] * normal(random)) +
          scale * responses[0].shift_per_mm + led * responses[1].shift_per_mm +
          normal(random) * responses[2].shift_per_mm;
      ReadChannel out = channel("PP", 'G', at[0], at[1]);
      out.sigma_s_prime_per_mm.std = std::sqrt(covariance(0, 0));
      out.sigma_a_per_mm.std = std::sqrt(covariance(1, 1));
      out.correlation = covariance(0, 1) / out.sigma_s_prime_per_mm.std / out.sigma_a_per_mm.std;
      out.responses = responses;
      out.budget = {{"noise", noise[0], noise[1]},
                    {"scale", 0.028, 4e-4},
                    {"LED position", 0.018, 3e-4},
                    {"eta", 0.025, 3e-4}};
      return out;
    };
    const ReadChannel a = drawn(), b = drawn();
    told += compare(a, b, true).p_value < 0.05 ? 1 : 0;
    told_apart += compare(a, b, false).p_value < 0.05 ? 1 : 0;
  }
  EXPECT_NEAR(told, 0.05 * kDraws, 4.0 * std::sqrt(0.05 * 0.95 * kDraws));
  EXPECT_LT(told_apart, told / 2);  // with the scale counted twice, less is seen
}

// A result beside itself, where the rig is all that is uncertain but for the noise.
TEST(Comparison, AResultIsLikeItself) {
  ReadChannel a = channel("PP", 'G', 1.0, 0.004);
  a.responses = {{"scale", "scale", {0.028, -4e-4}}};
  a.correlation = -0.9;
  EXPECT_EQ(compare(a, a, true).p_value, 1.0);
  a.responses[0].shift_per_mm = {0.031, -6e-4};  // more than the whole deviation
  const ChannelComparison c = compare(a, a, true);
  EXPECT_EQ(c.p_value, 1.0);
  EXPECT_NEAR(c.sigma_s_prime_per_mm.std, std::sqrt(18e-4), 1e-12);
}

TEST(Comparison, WithoutADeviationNothingIsCompared) {
  const ReadResult first = result({channel("PP", 'R', 1.0, 0.004), channel("PP", 'G', 1.0, 0.004)});
  ReadResult second = first;
  second.channels[1].sigma_a_per_mm.std = std::nan("");
  EXPECT_EQ(compare(first, second, {{"PP", "PP"}}, true)[0].channels.size(), 1U);
}

TEST(Comparison, IsOfTheMostImprobableChannel) {
  const ReadResult first = result({channel("PP", 'R', 1.0, 0.004), channel("PP", 'G', 1.0, 0.004)});
  ReadResult second = result({channel("PP", 'R', 1.0, 0.004), channel("PP", 'G', 1.3, 0.004),
                              channel("PP", 'B', 1.0, 0.004)});
  const auto compared = compare(first, second, {{"PP", "PP"}}, true);
  ASSERT_EQ(compared.size(), 1U);
  ASSERT_EQ(compared[0].channels.size(), 2U);
  EXPECT_TRUE(compared[0].is_different());
  EXPECT_EQ(compared[0].p_value, 2.0 * compared[0].channels[1].p_value);
  second.channels[1].refused = true;
  EXPECT_FALSE(compare(first, second, {{"PP", "PP"}}, true)[0].is_different());
  second.channels[0].refused = true;
  EXPECT_THAT(
      [&] {
        compare(first, second, {{"PP", "PP"}}, true);
      },
      ThrowsMessage<InputError>(HasSubstr("no channel is measured")));
}

TEST(Comparison, PairsAreNamedOrCommonOrTheOnlyOnes) {
  const ReadResult two = result({channel("PP", 'R', 1, 0), channel("PE", 'R', 1, 0)});
  const ReadResult one = result({channel("PE", 'R', 1, 0)}, "b.json");
  const ReadResult other = result({channel("wax", 'R', 1, 0)}, "c.json");
  EXPECT_THAT(pairs_of(two, one, {}), ElementsAre(Pair("PE", "PE")));
  EXPECT_THAT(pairs_of(one, other, {}), ElementsAre(Pair("PE", "wax")));
  EXPECT_THAT(pairs_of(two, other, {"PP=wax"}), ElementsAre(Pair("PP", "wax")));
  EXPECT_THAT(pairs_of(two, two, {"PP=PE", "PE"}), ElementsAre(Pair("PP", "PE"), Pair("PE", "PE")));
  EXPECT_THAT([&] { pairs_of(two, other, {}); },
              ThrowsMessage<InputError>(HasSubstr("--material PP=wax")));
  EXPECT_THAT([&] { pairs_of(two, other, {"PP=wacks"}); },
              ThrowsMessage<InputError>(HasSubstr("c.json")));
}

TEST(Comparison, RigsAreTheSameByTheirDigest) {
  ReadResult a, b;
  EXPECT_FALSE(have_same_rig(a, b));
  a.rig_sha256 = b.rig_sha256 = "12ab";
  EXPECT_TRUE(have_same_rig(a, b));
  b.rig_sha256 = "34cd";
  EXPECT_FALSE(have_same_rig(a, b));
}

}  // namespace
}  // namespace scattermeter::apps
