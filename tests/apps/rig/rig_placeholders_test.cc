#include "apps/rig/rig_placeholders.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/temporary_folder.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

TEST(RigPlaceholders, AreListedByLine) {
  const TemporaryFolder folder;
  const std::string path = folder / "rig.yaml";
  EXPECT_EQ(placeholder_note(path), "");  // no file
  write_file(path, std::string("a: 1   # MEASURE: a\nb: 2\nc: 3   # MEASURE: c\n"));
  EXPECT_THAT(placeholder_note(path), HasSubstr("rig.yaml: placeholders"));
  EXPECT_THAT(placeholder_note(path), HasSubstr("in line 1, 3)"));
  write_file(path, std::string("a: 1   # measured\n"));
  EXPECT_EQ(placeholder_note(path), "");
}

}  // namespace
}  // namespace scattermeter::apps
