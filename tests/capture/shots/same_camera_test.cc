#include "capture/shots/same_camera.h"

#include <gtest/gtest.h>

namespace scattermeter::capture {
namespace {

TEST(SameCamera, MakeIsOptionalAndCaseIsIgnored) {
  for (const char* wanted : {"NIKON D80", "Nikon D80", "D80", "d80"}) {
    EXPECT_TRUE(capture::same_camera(wanted, "Nikon", "D80")) << wanted;
  }
}

TEST(SameCamera, OtherModelsAndMakesDiffer) {
  EXPECT_FALSE(capture::same_camera("D8", "Nikon", "D80"));
  EXPECT_FALSE(capture::same_camera("D800", "Nikon", "D80"));
  EXPECT_FALSE(capture::same_camera("Canon D80", "Nikon", "D80"));
  EXPECT_FALSE(capture::same_camera("", "Nikon", "D80"));
}

}  // namespace
}  // namespace scattermeter::capture
