#include <cmath>

#include <gtest/gtest.h>

#include "apps/deviations/deviation_runs.h"

namespace scattermeter::apps {
namespace {

TrueSetup deviating_sensor(const char* kind, const DeviationDraw& draw) {
  const DeviationRun run{.kind = &deviation_named(kind), .body = "cube"};
  TrueSetup setup = true_setup(stated_rig(run, 320), stated_mesh("cube"));
  run.kind->truth(setup, draw);
  return setup;
}

// A frame of 1000 counts of 4000.
ColourFrame changed(const char* kind, const DeviationDraw& draw) {
  std::vector<ColourFrame> frames(2, black_frame(100, 80, 4000.0));
  for (ColourFrame& frame : frames) {
    frame.object = {20, 20, 60, 40};
    for (auto& plane : frame.counts) plane.assign(plane.size(), 1000.0F);
  }
  deviation_named(kind).frames(frames, draw);
  return frames[0];
}

TEST(SensorDeviations, Truths) {
  const SceneSensor& clipped = deviating_sensor("clips early", {60, 1, 1}).rig.scene.camera.sensor;
  EXPECT_EQ(clipped.white_counts, 64 + static_cast<int>(0.4 * (4095 - 64)));
  const SensorNoise stated;
  const SceneSensor noisy =
      deviating_sensor("noise underestimated", {2, 1, 1}).rig.scene.camera.sensor;
  EXPECT_NEAR(noisy.noise.gain_e_per_count, 1.5, 1e-12);  // a quarter of 6
  EXPECT_NEAR(noisy.noise.read_noise_counts, 2.4, 1e-12);
  const Rig green = deviating_sensor("responsivity of G off", {20, -1, 1}).rig;
  EXPECT_NEAR((*green.scene.camera.responsivity)[1], 0.8 * 2.9e10, 1.0);
  EXPECT_NEAR((*green.scene.camera.responsivity)[0], 2.4e10, 1.0);
  const CfaPattern before = deviating_sensor("clips early", {20, 1, 1}).rig.scene.camera.sensor.cfa;
  for (const double size : {1.0, 2.0}) {
    const CfaPattern after =
        deviating_sensor("colour filters exchanged", {size, 1, 1}).rig.scene.camera.sensor.cfa;
    const int dx = size == 1.0 ? 1 : 0;
    const int dy = size == 2.0 ? 1 : 0;
    EXPECT_EQ(after.at(0, 0), before.at(dx, dy)) << size;
    EXPECT_EQ(after.at(1, 0), before.at(1 + dx, dy)) << size;
    EXPECT_EQ(after.at(1, 1), before.at(1 + dx, 1 + dy)) << size;
  }
}

TEST(SensorDeviations, Counts) {
  EXPECT_NEAR(changed("exposure time off", {40, -1, 1}).at(0, 5, 5), 600.0, 1e-3);
  EXPECT_NEAR(changed("exposure of one shot off", {40, 1, 1}).at(0, 5, 5), 600.0, 1e-3);
  EXPECT_NEAR(changed("response not linear", {10, 1, 1}).at(2, 5, 5), 4000.0 * std::pow(0.25, 1.1),
              1e-2);
  // 3 % of the pixels have 1200 counts more.
  EXPECT_NEAR(mean_counts(changed("hot pixels", {3, 1, 5}), 1), 1000.0 + 0.03 * 1200.0, 5.0);
  const ColourFrame dusty = changed("dust on the sensor", {50, 1, 5});
  EXPECT_LT(mean_counts(dusty, 0), 1000.0);
  EXPECT_EQ(dusty.at(0, 0, 0), 1000.0F);
}

}  // namespace
}  // namespace scattermeter::apps
