#include "apps/deviations/unit_pictures.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "apps/deviations/deviation_runs.h"

namespace scattermeter::apps {
namespace {

TrueSetup pictured_setup() {
  const DeviationRun run{.kind = &deviation_named("none"), .body = "cube"};
  return true_setup(stated_rig(run, 240), stated_mesh("cube"));
}

TEST(UnitPictures, RendersWhatIsNewAndNothingTwice) {
  const TrueSetup setup = pictured_setup();
  UnitPictures pictures(10'000);
  const TrueShot& shot = setup.shots[0];
  const auto first = pictures.of(setup, shot.lights[0], shot.media, false);
  EXPECT_EQ(pictures.rendered(), 1U);
  EXPECT_EQ(first->variance_px_per_radiance, (std::array<double, 3>{}));
  // Power, sensor and the other lights do not matter.
  TrueSetup same = setup;
  same.rig.truth.sensor.veiling_glare = 0.1;
  same.shots[0].lights[0].led()->led.intensity_W_per_sr *= 3.0;
  EXPECT_EQ(pictures.of(same, same.shots[0].lights[0], shot.media, false), first);
  EXPECT_EQ(pictures.rendered(), 1U);
  // Place, camera, mesh, eta and media do.
  TrueSetup other = setup;
  other.rig.truth.pose->look_at_mm.x() += 1.0;
  EXPECT_NE(pictures.of(other, shot.lights[0], shot.media, false), first);
  other = setup;
  other.mesh.vertices_mm[0].x() -= 0.1;
  EXPECT_NE(pictures.of(other, shot.lights[0], shot.media, false), first);
  other = setup;
  other.rig.scene.objects[0].eta_int_over_ext = 1.4;
  EXPECT_NE(pictures.of(other, shot.lights[0], shot.media, false), first);
  EXPECT_NE(pictures.of(setup, setup.shots[1].lights[0], shot.media, false), first);
  std::array<Medium, 3> media = shot.media;
  media[2].sigma_a_per_mm *= 2.0;
  EXPECT_NE(pictures.of(setup, shot.lights[0], media, false), first);
  EXPECT_EQ(pictures.rendered(), 6U);
}

// The Monte Carlo's variance falls with the number of paths, and its picture is like the dipole's.
TEST(UnitPictures, Volume) {
  const TrueSetup setup = pictured_setup();
  const TrueShot& shot = setup.shots[0];
  UnitPictures few(10'000), more(90'000);
  const auto a = few.of(setup, shot.lights[0], shot.media, true);
  const auto b = more.of(setup, shot.lights[0], shot.media, true);
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_GT(a->variance_px_per_radiance[c], 4.0 * b->variance_px_per_radiance[c]);
    EXPECT_GT(b->variance_px_per_radiance[c], 0.0);
  }
  EXPECT_EQ(few.of(setup, shot.lights[0], shot.media, true), a);
  const auto dipole = more.of(setup, shot.lights[0], shot.media, false);
  for (std::size_t c = 0; c < 3; ++c) {
    double volume_sum = 0.0;
    double dipole_sum = 0.0;
    for (std::size_t i = c; i < b->radiance.rgb.size(); i += 3) {
      volume_sum += static_cast<double>(b->radiance.rgb[i]);
      dipole_sum += static_cast<double>(dipole->radiance.rgb[i]);
    }
    EXPECT_NEAR(volume_sum / dipole_sum, 1.0, 0.25) << c;
  }
}

TEST(UnitPictures, ForgetsWhatWasUsedLeast) {
  const TrueSetup setup = pictured_setup();
  UnitPictures pictures(10'000, 2);
  const auto of = [&](std::size_t shot, bool bright) {
    std::array<Medium, 3> media = setup.shots[0].media;
    if (bright) media[0].sigma_a_per_mm = 0.0005;
    pictures.of(setup, setup.shots[shot].lights[0], media, false);
    return pictures.rendered();
  };
  EXPECT_EQ(of(0, false), 1U);
  EXPECT_EQ(of(1, false), 2U);
  EXPECT_EQ(of(0, false), 2U);
  EXPECT_EQ(of(0, true), 3U);   // instead of the second
  EXPECT_EQ(of(0, false), 3U);  // still there
  EXPECT_EQ(of(1, false), 4U);
}

}  // namespace
}  // namespace scattermeter::apps
