#include "apps/export/export_notes.h"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/apps/exported.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

TEST(ExportNotes, EveryFileStatesUnitScaleAndUncertainty) {
  const Exported exported;
  for (const char* format : {"mitsuba", "pbrt", "blender", "openpbr", "materialx"}) {
    const std::string text = exported.text(format, {"--mm-per-unit", "25.4"});
    EXPECT_THAT(text, HasSubstr("1 scene unit = 25.4 mm")) << format;
    EXPECT_THAT(text, ::testing::ContainsRegex(
                          "POM R: sigma_s' 1.4 [+]- 0.35 per mm, sigma_a 0.002 [+]- 0.0005"))
        << format;
  }
}

TEST(ExportNotes, OriginScaleAndPhaseFunction) {
  ReadResult result;
  result.version = "1.2";
  result.path = "a\nb/result.json";
  std::vector<std::string> notes = export_notes(result, {2.5, 0.0});
  ASSERT_EQ(notes.size(), 4U);
  EXPECT_EQ(notes[0], "Measured by scattermeter 1.2: a b/result.json");
  EXPECT_EQ(notes[1], "Scale: 1 scene unit = 2.5 mm (option mm-per-unit).");
  EXPECT_THAT(notes[2], HasSubstr("Phase function: isotropic."));
  notes = export_notes(result, {1.0, 0.8});
  EXPECT_THAT(notes[2], HasSubstr("Henyey-Greenstein with g = 0.8"));
}

TEST(ExportNotes, ValuesOfEachChannel) {
  MeasuredMaterial m;
  for (std::size_t c = 0; c < 3; ++c) {
    m.rgb[c].material = "P\tOM";
    m.rgb[c].channel = "RGB"[c];
    m.rgb[c].model = "dipole";
    m.rgb[c].eta_int_over_ext = 1.4;
    m.rgb[c].sigma_s_prime_per_mm = {1.5, 0.0123, 0, 0};
    m.rgb[c].sigma_a_per_mm = {0.002, std::numeric_limits<double>::quiet_NaN(), 0, 0};
  }
  const std::vector<std::string> notes = value_notes(m);
  ASSERT_EQ(notes.size(), 3U);
  EXPECT_EQ(
      notes[1],
      "P OM G: sigma_s' 1.5 +- 0.012 per mm, sigma_a 0.002 (standard deviation not known) per "
      "mm, eta 1.4, model dipole");
}

}  // namespace
}  // namespace scattermeter::apps
