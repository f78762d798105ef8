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

}  // namespace
}  // namespace scattermeter::apps
