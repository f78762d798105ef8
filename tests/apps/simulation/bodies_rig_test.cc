#include "apps/simulation/bodies_rig.h"

#include <gtest/gtest.h>

#include "apps/instrument/instrument.h"
#include "apps/simulation/virtual_shots.h"

namespace scattermeter::apps {
namespace {

// Shots that the dipole made of each body come back from the dipole: camera, lights and patches
// suit the bodies. To what bench materials takes for right.
TEST(BodiesRig, EveryBodyIsMeasured) {
  const Medium medium{0.8, 0.01, 1.0};
  for (const char* body : {"sphere", "slab", "scan"}) {
    const Rig rig = bodies_rig(968, 1.3, {{"m", {medium, medium, medium}}}, {body});
    const ObjectScenes scenes = bodies_scenes(rig);
    const VirtualShots shots(rig, scenes, {.noise = true});
    MeasureOptions options;

    Instrument instrument(rig, scenes, options);
    const Measurement m = instrument.measure(capture::shots_from(
        rig.scene, capture::all_shots(rig.scene),
        capture::SampleSource([&](std::size_t i, const SampleMap& where) {
          return shots.ideal_samples(i, where.x0, where.y0, where.width, where.height);
        })));
    for (const ChannelResult& r : m.results) {
      EXPECT_FALSE(r.refused()) << body << ": " << r.estimate.reasons.front();
      EXPECT_NEAR(r.estimate.sigma_s_prime_per_mm.value, 0.8, 0.01 * 0.8) << body;
      EXPECT_NEAR(r.estimate.sigma_a_per_mm.value, 0.01, 0.05 * 0.01) << body;
    }
  }
}

}  // namespace
}  // namespace scattermeter::apps
