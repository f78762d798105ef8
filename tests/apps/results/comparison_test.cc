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
  return out;
}

ReadResult result(const std::vector<ReadChannel>& channels, const std::string& path = "a.json") {
  ReadResult out;
  out.path = path;
  out.channels = channels;
  return out;
}

// 2 (0.03^2), less twice 0.02^2 of the scale that one rig has in both; eta is each material's own.
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

// Results of one material under one rig: the errors of scale, noise and eta are drawn.
TEST(Comparison, EqualMaterialsAreRarelyTold) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  constexpr int kDraws = 20000;
  int told = 0, told_apart = 0;
  for (int i = 0; i < kDraws; ++i) {
    const double scale = normal(random);
    const auto drawn = [&] {
      const double noise = normal(random), other = normal(random), eta = normal(random);
      return channel("PP", 'G', 1.0 + 0.01 * noise + 0.02 * scale + 0.02 * eta,
                     0.004 + 3e-4 * other + 3e-4 * scale + std::sqrt(7e-8) * normal(random));
    };
    const ReadChannel a = drawn(), b = drawn();
    told += compare(a, b, true).p_value < 0.05 ? 1 : 0;
    told_apart += compare(a, b, false).p_value < 0.05 ? 1 : 0;
  }
  EXPECT_NEAR(told, 0.05 * kDraws, 4.0 * std::sqrt(0.05 * 0.95 * kDraws));
  EXPECT_LT(told_apart, told / 2);  // with the scale counted twice, less is seen
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
