#include "apps/planning/exposure_advice.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "apps/planning/plan.h"
#include "tests/fixtures/apps/body_rig.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

// Ten times too long clips, thirty times too short is dark; what is suggested is neither.
TEST(ExposureAdvice, NeitherClipsNorIsDark) {
  const auto advised = [](double exposure_s) {
    Rig rig = body_rig("cube", 1);
    rig.scene.camera.exposure_s = exposure_s;
    PlanOptions options;
    options.suggested_shots = false;

    return plan(rig, bodies_scenes(rig), options);
  };
  const Plan chosen = [] {
    const Rig rig = body_rig("cube", 1);
    PlanOptions options;
    options.suggested_shots = false;

    return plan(rig, bodies_scenes(rig), options);
  }();
  ASSERT_EQ(chosen.exposures.size(), 3U);
  const double right_s = chosen.exposures[0].exposure_s[0];
  EXPECT_TRUE(chosen.exposures[0].chosen);
  EXPECT_EQ(chosen.exposures[1].advice, "");
  const Plan bright = advised(10.0 * right_s);
  EXPECT_TRUE(bright.any_refused());
  EXPECT_GT(bright.exposures[1].clipped_share, 0.1);
  EXPECT_THAT(bright.exposures[1].advice, HasSubstr("clipped"));
  const Plan dark = advised(right_s / 30.0);
  EXPECT_EQ(dark.exposures[1].clipped_share, 0.0);
  EXPECT_THAT(dark.exposures[1].advice, HasSubstr("of the range"));
  for (const Plan* p : {&bright, &dark}) {
    ASSERT_FALSE(p->exposures[1].suggested_s.empty());
    EXPECT_NEAR(p->exposures[1].suggested_s[0] / right_s, 1.0, 0.2);
  }
}

}  // namespace
}  // namespace scattermeter::apps
