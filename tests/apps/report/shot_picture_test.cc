#include "apps/report/shot_picture.h"

#include <gtest/gtest.h>

#include "core/mesh/bodies.h"
#include "tests/fixtures/apps/overhead_view.h"

namespace scattermeter::apps {
namespace {

int png_width(const std::string& png) {
  return static_cast<unsigned char>(png[18]) * 256 + static_cast<unsigned char>(png[19]);
}

// The cube from above: 21 px of a frame of 240, a margin of a tenth, enlarged.
TEST(ShotPicture, ShowsTheObjectAndItsClippedSamples) {
  const CameraView view = overhead_view(0, 0);
  const RayScene cube(cube_mesh());
  capture::RawFrame frame;
  frame.width_px = 240;
  frame.height_px = 200;
  frame.samples.assign(240U * 200U, 1000);
  frame.black_counts.fill(64);
  frame.white_counts = 4095;
  SampleMap map;
  map.x0 = 109;
  map.y0 = 89;
  map.width = map.height = 22;
  const std::string plain = shot_picture(frame, view, cube, map, 200);
  ASSERT_GT(plain.size(), 100U);
  EXPECT_EQ(plain.substr(1, 3), "PNG");
  EXPECT_GT(png_width(plain), 80);
  EXPECT_LE(png_width(plain), 210);
  EXPECT_EQ(shot_picture(frame, view, cube, map, 200), plain);
  // Clipped beside the object's rectangle: nothing is marked.
  frame.samples[0] = 4095;
  EXPECT_EQ(shot_picture(frame, view, cube, map, 200), plain);
  frame.samples[100 * 240 + 120] = 4095;
  EXPECT_NE(shot_picture(frame, view, cube, map, 200), plain);
}

}  // namespace
}  // namespace scattermeter::apps
