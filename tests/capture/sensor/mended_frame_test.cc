#include "capture/sensor/mended_frame.h"

#include <gtest/gtest.h>

namespace scattermeter::capture {
namespace {

RawFrame frame_of(int width_px, int height_px) {
  RawFrame frame;
  frame.width_px = width_px;
  frame.height_px = height_px;
  for (int i = 0; i < width_px * height_px; ++i) {
    frame.samples.push_back(static_cast<std::uint16_t>(100 * i));
  }
  return frame;
}

TEST(MendedFrame, TakesTheMeanOfItsFilterNearby) {
  RawFrame frame = frame_of(6, 5);
  frame.samples[14] = 4095;
  mend_defects({14}, frame);
  EXPECT_EQ(frame.samples[14], 1400);  // of 1200, 1600, 200 and 2600
  // Beside another defect, and at the corner.
  frame.samples[0] = frame.samples[2] = 4095;
  mend_defects({0, 2}, frame);
  EXPECT_EQ(frame.samples[0], 1200);                                // below it
  EXPECT_EQ(frame.samples[2], static_cast<int>((400 + 1400) / 2));  // beside and below it
  EXPECT_EQ(frame.samples[1], 100);
}

TEST(MendedFrame, OneWithoutNeighboursStays) {
  RawFrame frame = frame_of(2, 2);
  mend_defects({3, 70}, frame);
  EXPECT_EQ(frame.samples[3], 300);
}

}  // namespace
}  // namespace scattermeter::capture
