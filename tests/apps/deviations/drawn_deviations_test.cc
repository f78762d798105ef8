#include <cmath>
#include <cstdio>
#include <vector>

#include <gtest/gtest.h>

#include "apps/bench/estimate_statistics.h"
#include "apps/deviations/deviation_report.h"
#include "apps/deviations/deviation_runs.h"
#include "core/scene/default_uncertainty.h"
#include "tests/fixtures/draws.h"

namespace scattermeter::apps {
namespace {

// Over many draws, what is drawn has the deviation that the rig states.
TEST(DrawnDeviations, SpreadIsAsStated) {
  const DeviationRun run{.kind = &deviation_named("rig drawn as stated"), .body = "cube"};
  const Rig stated = stated_rig(run, 320);
  const TrueSetup plain = true_setup(stated, stated_mesh("cube"));
  constexpr int kDraws = 400;
  std::vector<double> eta, responsivity, focal_length, mark_px, left_mm;
  for (int i = 0; i < kDraws; ++i) {
    const DeviationDraw draw{1.0, 1.0, static_cast<std::uint64_t>(i)};
    TrueSetup setup = plain;
    run.kind->truth(setup, draw);
    eta.push_back(setup.rig.scene.objects.front().eta_int_over_ext);
    responsivity.push_back((*setup.rig.scene.camera.responsivity)[1] /
                           (*plain.rig.scene.camera.responsivity)[1]);
    focal_length.push_back(setup.rig.scene.camera.intrinsics.fx_px /
                           plain.rig.scene.camera.intrinsics.fx_px);
    left_mm.push_back(bounds(setup.mesh).center_mm().x());
    EXPECT_TRUE(setup.marks_by_true_camera);
    EXPECT_GT(setup.shots.front().lights.size(), plain.shots.front().lights.size());
    Rig read = stated;
    run.kind->stated(read, draw);
    mark_px.push_back(read.pose.points.front().image_px.x());
  }
  // The relative error of a deviation from so many draws is 3.5 %.
  constexpr double kFar = 0.15;
  const auto expect_std = [&](const std::vector<double>& values, double std) {
    EXPECT_NEAR(sampled_std(values), std, kFar * std);
  };
  expect_std(eta, default_uncertainty::kEta);
  expect_std(responsivity, 0.02);
  expect_std(focal_length, default_uncertainty::kFocalLength);
  expect_std(left_mm, default_uncertainty::kObjectPosition_mm);
  expect_std(mark_px, stated.pose.options.point_std_px);
}

// Rigs of which everything is a little off, as their files say, are measured rightly.
TEST(DrawnDeviationsStatistics, AreAnsweredAndRight) {
  DeviationOptions options;
  options.image_width_px = 484;
  options.rendering = DeviationRendering::kDipole;
  options.kinds = {"rig drawn as stated"};
  options.bodies = {"cube", "pyramid"};
  options.runs = test_support::long_run() ? 200 : 6;
  options.seed = 11;
  DeviationCount count;
  options.on_result = [&](const DeviationResult& r) {
    count.add(r.judged);
    if (r.judged.verdict != DeviationVerdict::kWrongOk) return;
    std::printf("wrong: %s, %d LEDs, seed %llu\n", r.run.body.c_str(), r.run.leds,
                static_cast<unsigned long long>(r.run.seed));
  };
  bench_deviations(options);
  std::printf("%d answers, %.1f %% answered, %d wrong, %.1f %% in the 95 %% intervals\n",
              count.runs, 100.0 * count.answered_share(), count.wrong_ok,
              100.0 * count.coverage95());
  // Of the two values of 600 answers with normal errors, 3 are more than three deviations off; more
  // than 9 once in a thousand.
  EXPECT_LE(count.wrong_ok, test_support::long_run() ? 9 : 0);
  EXPECT_GE(count.answered_share(), 0.9);
  // Of 36 intervals, which three channels share; less than this by chance once in some thousand.
  EXPECT_GE(count.coverage95(), test_support::long_run() ? 0.92 : 0.75);
}

}  // namespace
}  // namespace scattermeter::apps
