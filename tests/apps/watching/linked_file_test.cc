#include "apps/watching/linked_file.h"

#include <string>

#include <gtest/gtest.h>

#include "core/base/input_error.h"
#include "tests/fixtures/apps/small_rig.h"
#include "tests/fixtures/temporary_folder.h"

namespace scattermeter::apps {
namespace {

TEST(LinkedFile, ReplacesWhatWasThere) {
  const TemporaryFolder folder;
  write_file(folder / "a", std::string("first"));
  write_file(folder / "b", std::string("second"));
  link_or_copy(folder / "a", folder / "deep/c");
  EXPECT_EQ(slurp(folder / "deep/c"), "first");
  link_or_copy(folder / "b", folder / "deep/c");
  EXPECT_EQ(slurp(folder / "deep/c"), "second");
  EXPECT_EQ(slurp(folder / "a"), "first");
  EXPECT_THROW(link_or_copy(folder / "a", "/proc/none/c"), InputError);
}

}  // namespace
}  // namespace scattermeter::apps
