#include "apps/export/colour_notes.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

MeasuredMaterial noted_material() {
  MeasuredMaterial m;
  for (std::size_t c = 0; c < 3; ++c) {
    m.rgb[c].sigma_s_prime_per_mm.value = 3.0;
    m.rgb[c].sigma_a_per_mm.value = c == 0 ? 1.0 : c == 1 ? 0.0 : 0.03;
  }
  return m;
}

TEST(ColourNotes, ReducedAlbedo) {
  const std::array<double, 3> albedo = reduced_albedo(noted_material());
  EXPECT_DOUBLE_EQ(albedo[0], 0.75);
  EXPECT_DOUBLE_EQ(albedo[1], 1.0);
  EXPECT_DOUBLE_EQ(albedo[2], 3.0 / 3.03);
}

// Van de Hulst by hand: s = sqrt(1 - 0.75) = 0.5, (1 - 0.5)(1 - 0.0695) / 1.585 = 0.293533.
TEST(ColourNotes, TellsWhatTheRendererWillDo) {
  const std::vector<std::string> notes = colour_notes(openpbr_colour(), noted_material());
  ASSERT_EQ(notes.size(), 4U);
  EXPECT_THAT(notes[0], HasSubstr("Colour from albedo by " + openpbr_colour().source));
  EXPECT_THAT(notes[1], HasSubstr("R: albedo 0.75000000, colour 0.2935"));
  // The colour is the fit's inverse: the renderer gets sigma_a back.
  EXPECT_THAT(notes[1], HasSubstr("sigma_a = 1 per mm"));
  EXPECT_THAT(notes[2], HasSubstr("G: albedo 1.00000000, colour 1.000000"));
  EXPECT_THAT(notes[3], HasSubstr("sigma_a = 0.03 per mm"));
}

}  // namespace
}  // namespace scattermeter::apps
