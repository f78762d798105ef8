#include "apps/simulation/shot_renderer.h"

#include <gtest/gtest.h>

#include "apps/rig/open_objects.h"
#include "tests/fixtures/apps/small_rig.h"

namespace scattermeter::apps {
namespace {

// What a shot records through its filters is what the picture shows.
TEST(ShotRenderer, ShowsWhatTheCameraSees) {
  SmallRig small;
  small.keep_shots("PE_pyramid_2");
  Rig rig = read_rig(small.rig());
  const ObjectScenes scenes = open_objects(rig);
  ShotRenderer renderer(rig, scenes);
  const RadiancePicture shot = renderer.render(rig.scene.shots[0]);
  const ColourRadiance colour = renderer.render_colour(rig.scene.shots[0]);
  ASSERT_EQ(colour.width, shot.width);
  ASSERT_EQ(colour.height, shot.height);
  std::size_t lit = 0;
  for (int y = 0; y < shot.height; ++y) {
    for (int x = 0; x < shot.width; ++x) {
      const auto i = static_cast<std::size_t>(y * shot.width + x);
      const int channel = renderer.channel(shot.x0 + x, shot.y0 + y);
      ASSERT_EQ(shot.radiance[i], colour.rgb[3 * i + static_cast<std::size_t>(channel)]);
      lit += shot.radiance[i] > 0.0F;
    }
  }
  EXPECT_GT(lit, 5000U);
}

}  // namespace
}  // namespace scattermeter::apps
