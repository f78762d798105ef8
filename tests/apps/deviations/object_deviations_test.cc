#include <gtest/gtest.h>

#include "apps/deviations/deviation_runs.h"

namespace scattermeter::apps {
namespace {

TrueSetup deviating_object(const char* kind, const DeviationDraw& draw) {
  const DeviationRun run{.kind = &deviation_named(kind), .body = "cube"};
  TrueSetup setup = true_setup(stated_rig(run, 320), stated_mesh("cube"));
  run.kind->truth(setup, draw);
  return setup;
}

TEST(ObjectDeviations, Materials) {
  EXPECT_NEAR(deviating_object("eta off", {0.09, 1, 1}).rig.scene.objects.front().eta_int_over_ext,
              1.40, 1e-12);
  EXPECT_EQ(deviating_object("phase function", {0.8, 1, 1}).rig.scene.objects.front().phase,
            PhaseFunction(0.8));
  EXPECT_NEAR(deviating_object("phase function of two lobes", {50, 1, 1})
                  .rig.scene.objects.front()
                  .phase.mean_cosine(),
              0.45, 1e-12);
  EXPECT_EQ(deviating_object("rough surface", {0.15, 1, 1}).rig.scene.objects.front().surface_alpha,
            0.15);
  const TrueSetup halves = deviating_object("halves of different material", {50, 1, 1});
  for (const TrueShot& shot : halves.shots) {
    EXPECT_NEAR((*shot.right_half)[1].sigma_s_prime_per_mm, 1.5 * 1.3, 1e-12);
    EXPECT_NEAR(shot.media[1].sigma_s_prime_per_mm, 1.3, 1e-12);
  }
  const TrueSetup one = deviating_object("another material in one shot", {100, 1, 1});
  EXPECT_NEAR(one.shots[0].media[0].sigma_s_prime_per_mm, 0.6, 1e-12);
  EXPECT_NEAR(one.shots[1].media[0].sigma_s_prime_per_mm, 1.2, 1e-12);
}

TEST(ObjectDeviations, CoveredAndMarked) {
  std::vector<ColourFrame> frames(1, black_frame(100, 80, 4000.0));
  frames[0].object = {20, 20, 60, 40};
  for (auto& plane : frames[0].counts) plane.assign(plane.size(), 1000.0F);
  const std::vector<ColourFrame> plain = frames;
  for (const double sign : {1.0, -1.0}) {
    frames = plain;
    deviation_named("part covered").frames(frames, {50, sign, 1});
    EXPECT_EQ(frames[0].at(1, 25, 40), sign > 0 ? 1000.0F : 0.0F);
    EXPECT_EQ(frames[0].at(1, 75, 40), sign > 0 ? 0.0F : 1000.0F);
  }
  frames = plain;
  deviation_named("scratch").frames(frames, {90, 1, 1});
  EXPECT_LT(mean_counts(frames[0], 0), 1000.0);
  EXPECT_GT(mean_counts(frames[0], 0), 980.0);
  frames = plain;
  deviation_named("highlight").frames(frames, {20, 1, 1});
  EXPECT_NEAR(counts_exceeded(frames[0], 0.0), 1800.0, 1e-2);
}

}  // namespace
}  // namespace scattermeter::apps
