#include "apps/deviations/deviation_runs.h"

#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "apps/deviations/deviation_report.h"

namespace scattermeter::apps {
namespace {

TEST(DeviationRuns, WholeProduct) {
  DeviationOptions options;
  options.runs = 0;
  options.kinds = {"none", "edges bevelled", "LEDs exchanged", "phase function"};
  std::map<std::string, int> n;
  for (const DeviationRun& run : planned_runs(options)) {
    ++n[run.kind->name];
    EXPECT_FALSE(run.kind->needs.edges && run.body == "sphere");
    EXPECT_FALSE(run.kind->needs.two_leds && run.leds < 2);
    EXPECT_FALSE(run.kind->needs.volume && !run.volume);
  }
  EXPECT_EQ(n["none"], 3 * 2 * 2);
  EXPECT_EQ(n["edges bevelled"], 3 * 2 * 2 * 2);
  EXPECT_EQ(n["LEDs exchanged"], 3 * 2);
  EXPECT_EQ(n["phase function"], 4 * 3 * 2);
  options.kinds = {"nonsense"};
  EXPECT_THROW(planned_runs(options), std::invalid_argument);
}

// As many runs as wanted, the same for the same seed, and kinds and sizes in turn.
TEST(DeviationRuns, DrawnEvenly) {
  DeviationOptions options;
  options.runs = 400;
  options.rendering = DeviationRendering::kDipole;
  const std::vector<DeviationRun> runs = planned_runs(options);
  ASSERT_EQ(runs.size(), 400U);
  std::map<std::pair<const Deviation*, std::size_t>, int> n;
  std::set<std::string> bodies;
  std::set<int> leds;
  for (const DeviationRun& run : runs) {
    ++n[{run.kind, run.size_idx}];
    bodies.insert(run.body);
    leds.insert(run.leds);
    EXPECT_FALSE(run.volume);
  }
  int fewest = 400;
  int most = 0;
  for (const auto& [stratum, count] : n) {
    fewest = std::min(fewest, count);
    most = std::max(most, count);
  }
  EXPECT_LE(most - fewest, 1);
  EXPECT_EQ(bodies.size(), 3U);
  EXPECT_EQ(leds.size(), 2U);
  const std::vector<DeviationRun> again = planned_runs(options);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    EXPECT_EQ(again[i].kind, runs[i].kind);
    EXPECT_EQ(again[i].seed, runs[i].seed);
  }
  options.seed = 2;
  EXPECT_NE(planned_runs(options)[0].seed, runs[0].seed);
  options.rendering = DeviationRendering::kBoth;
  int volumes = 0;
  for (const DeviationRun& run : planned_runs(options)) volumes += run.volume ? 1 : 0;
  EXPECT_GT(volumes, 5);
  EXPECT_LT(volumes, 40);
}

TEST(DeviationRuns, OnlyWhatIsWanted) {
  DeviationOptions options;
  options.runs = 0;
  options.kinds = {"veiling glare"};
  options.bodies = {"sphere"};
  options.sizes = {2};
  options.leds = 1;
  options.rendering = DeviationRendering::kVolume;
  options.run_seed = 77;
  const std::vector<DeviationRun> runs = planned_runs(options);
  ASSERT_EQ(runs.size(), 1U);
  EXPECT_EQ(runs[0].body, "sphere");
  EXPECT_EQ(runs[0].size_idx, 2U);
  EXPECT_EQ(runs[0].leds, 1);
  EXPECT_TRUE(runs[0].volume);
  EXPECT_EQ(runs[0].seed, 77U);
}

// A small bench of its own: no wrong answer is given as ok, the control is answered, and gross
// deviations are refused.
TEST(DeviationRuns, NoWrongOk) {
  DeviationOptions options;
  options.image_width_px = 484;
  options.runs = 0;
  options.rendering = DeviationRendering::kDipole;
  options.bodies = {"cube"};
  options.leds = 2;
  options.kinds = {"none", "LEDs exchanged", "LED intensity in another unit", "hot pixels"};
  int seen = 0;
  options.on_result = [&](const DeviationResult& result) {
    ++seen;
    EXPECT_NE(result.judged.verdict, DeviationVerdict::kWrongOk) << deviation_line(result);
    if (result.run.kind->name == "none") {
      EXPECT_EQ(result.judged.verdict, DeviationVerdict::kRight) << deviation_line(result);
    }
    if (result.run.kind->name == "LED intensity in another unit") {
      EXPECT_EQ(result.judged.verdict, DeviationVerdict::kRefused) << deviation_line(result);
    }
    if (result.run.kind->name == "hot pixels" && result.run.size_idx == 2) {
      EXPECT_EQ(result.judged.verdict, DeviationVerdict::kRefused) << deviation_line(result);
      EXPECT_TRUE(result.judged.names_cause) << deviation_line(result);
    }
  };
  const std::vector<DeviationResult> results = bench_deviations(options);
  EXPECT_EQ(results.size(), 3U * (1 + 1 + 3 + 3));
  EXPECT_EQ(seen, static_cast<int>(results.size()));
}

// Deviations that the estimate follows: at least three quarters of the answers are given, and none
// of these is wrong.
class DeviationsFollowed : public ::testing::Test {
 protected:
  static void expect_right(const std::vector<std::string>& kinds, int size,
                           const std::vector<std::string>& bodies) {
    DeviationOptions options;
    options.image_width_px = 484;
    options.runs = 0;
    options.rendering = DeviationRendering::kDipole;
    options.bodies = bodies;
    options.kinds = kinds;
    options.sizes = {size};
    options.run_seed = 2;
    int given = 0;
    const std::vector<DeviationResult> results = bench_deviations(options);
    for (const DeviationResult& result : results) {
      EXPECT_NE(result.judged.verdict, DeviationVerdict::kWrongOk) << deviation_line(result);
      given += result.judged.verdict == DeviationVerdict::kRight ? 1 : 0;
    }
    EXPECT_GE(4 * given, 3 * static_cast<int>(results.size()));
  }
};

// Out of focus by 1.5 px or moved by 4 px, where the mean free path is 3 to 12 px.
TEST_F(DeviationsFollowed, Blur) {
  expect_right({"out of focus", "motion blur"}, 1, {"cube", "pyramid", "sphere"});
}

// By 0.09, and 5 % of the light about the object.
TEST_F(DeviationsFollowed, EtaFarOffAndHalos) {
  expect_right({"eta off", "halo of the lens"}, 2, {"cube", "pyramid"});
}

// A wrong answer would be noticed: the same answers, judged by another truth.
TEST(DeviationRuns, WouldNotice) {
  DeviationOptions options;
  options.image_width_px = 484;
  options.runs = 0;
  options.rendering = DeviationRendering::kDipole;
  options.bodies = {"cube"};
  options.leds = 2;
  options.kinds = {"none"};
  std::vector<DeviationResult> results = bench_deviations(options);
  EXPECT_EQ(summarise(results).total.wrong_ok, 0);
  for (DeviationResult& r : results) {
    r.truth.sigma_s_prime_per_mm.low *= 1.5;
    r.truth.sigma_s_prime_per_mm.high *= 1.5;
    r.judged = judge_answer(r.estimate, r.truth, r.run.kind->words);
  }
  EXPECT_EQ(summarise(results).total.wrong_ok, 3);
}

}  // namespace
}  // namespace scattermeter::apps
