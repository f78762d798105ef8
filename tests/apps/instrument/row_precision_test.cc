#include "apps/instrument/row_precision.h"

#include <cmath>
#include <memory>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "apps/instrument/instrument.h"
#include "apps/results/result_json.h"
#include "apps/simulation/virtual_shots.h"
#include "tests/fixtures/apps/body_rig.h"

namespace scattermeter::apps {
namespace {

constexpr PrecisionGoal kGoal{0.01, 0.05};
constexpr int kLevels = 10;

// Deviations of noise alone fall with the root of the rows: of a sixteenth of all.
ChannelResult fitted(double relative_std_s, double relative_std_a) {
  ChannelResult r{};
  r.estimate.rows = 1000;
  r.estimate.converged = true;
  r.estimate.sigma_s_prime_per_mm = normal_quantity(2.0, 2.0 * relative_std_s);
  r.estimate.sigma_a_per_mm = normal_quantity(0.01, 0.01 * relative_std_a);
  r.image_in_std = 1e5;
  for (double times = 1.0; times <= 16.0; times *= 2.0) {
    r.more_rows.push_back(
        {times, 2.0 * relative_std_s / std::sqrt(times), 0.01 * relative_std_a / std::sqrt(times)});
  }
  return r;
}

std::optional<int> needed(const ChannelResult& r) {
  return levels_needed(std::vector<ChannelResult>{fitted(0.002, 0.01), r}, kGoal, kLevels, 16.0);
}

TEST(RowPrecision, AsManyRowsAsTheGoalTakes) {
  EXPECT_EQ(needed(fitted(0.009, 0.049)), kLevels);
  EXPECT_EQ(needed(fitted(0.012, 0.01)), kLevels + 1);
  EXPECT_EQ(needed(fitted(0.002, 0.089)), kLevels + 2);
  // More than half of them: all.
  EXPECT_EQ(needed(fitted(0.033, 0.01)), std::nullopt);
  EXPECT_EQ(needed(fitted(0.2, 0.01)), std::nullopt);
}

// What was added to the fit's variance remains however many rows there are.
TEST(RowPrecision, RowsDoNotHelpAgainstWhatWidensTheFit) {
  ChannelResult r = fitted(0.002, 0.01);
  r.estimate.sigma_s_prime_per_mm.std = 2.0 * 0.0098;
  EXPECT_EQ(needed(r), kLevels);
  r.estimate.sigma_s_prime_per_mm.std = 2.0 * 0.0102;
  EXPECT_EQ(needed(r), std::nullopt);
}

TEST(RowPrecision, AnImageThatHidesWhatTheDipoleMissesNeedsMore) {
  ChannelResult r = fitted(0.002, 0.01);
  r.image_in_std = 5e3;
  EXPECT_EQ(needed(r), kLevels + 2);
}

TEST(RowPrecision, DoubtsAreJudgedByAllRows) {
  ChannelResult refused = fitted(0.002, 0.01);
  refused.estimate.reasons = {"the shots contradict the scale"};
  EXPECT_EQ(needed(refused), std::nullopt);
  ChannelResult torn = fitted(0.002, 0.01);
  torn.agreement = {40.0, 6, 1e-5};
  EXPECT_EQ(needed(torn), std::nullopt);
  ChannelResult transport = fitted(0.002, 0.01);
  transport.why_transport = "the dipole misses 4 % of the image";
  EXPECT_EQ(needed(transport), std::nullopt);
  // A channel that is dark does not take part.
  ChannelResult dark{};
  dark.estimate.reasons = {"the shot is dark"};
  EXPECT_EQ(needed(dark), kLevels);
}

// A cube of some 6000 patches in each shot.
class CubeOfManyPatches : public ::testing::Test {
 protected:
  CubeOfManyPatches()
      : rig_(bodies_rig(1100, 1.4, {{"plastic", plastic()}}, {"cube"})),
        scenes_(bodies_scenes(rig_)) {
    rig_.path = "";
    rig_.scene.shots.resize(2);
    shots_ = std::make_unique<VirtualShots>(rig_, scenes_, VirtualShotOptions{.noise = true});
  }
  Measurement measured(std::optional<PrecisionGoal> goal) const {
    MeasureOptions options;
    options.estimate.model = "auto";
    options.patch_size_mm = 0.4;
    options.goal = goal;
    return Instrument(rig_, scenes_, options).measure(shots_->source(1));
  }

  Rig rig_;
  ObjectScenes scenes_;
  std::unique_ptr<VirtualShots> shots_;
};

TEST_F(CubeOfManyPatches, SkipsRowsWhereTheGoalIsReached) {
  const Measurement all = measured(std::nullopt);
  EXPECT_EQ(all.skipped.rows, 0U);
  const Measurement some = measured(PrecisionGoal{0.1, 1.0});
  ASSERT_EQ(some.results.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    const Estimate& e = some.results[i].estimate;
    EXPECT_FALSE(some.results[i].refused());
    EXPECT_EQ(some.results[i].model, "dipole");
    EXPECT_GE(all.results[i].estimate.rows, 2 * e.rows);
    const Medium truth = plastic()[i];
    EXPECT_NEAR(e.sigma_s_prime_per_mm.value, truth.sigma_s_prime_per_mm,
                3.3 * e.sigma_s_prime_per_mm.std);
    EXPECT_NEAR(e.sigma_a_per_mm.value, truth.sigma_a_per_mm, 3.3 * e.sigma_a_per_mm.std);
    EXPECT_GT(e.sigma_s_prime_per_mm.std, all.results[i].estimate.sigma_s_prime_per_mm.std);
  }
  EXPECT_GT(some.skipped.rows, 4000U);
  // A goal beyond reach: all rows, and the digits of no goal.
  const Measurement again = measured(PrecisionGoal{1e-6, 1e-6});
  EXPECT_EQ(again.skipped.rows, 0U);
  const auto results = [](const Measurement& m) {
    return nlohmann::json::parse(result_json(m, ""))["results"];
  };
  EXPECT_EQ(results(again), results(all));
}

}  // namespace
}  // namespace scattermeter::apps
