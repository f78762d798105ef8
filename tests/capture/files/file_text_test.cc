#include "capture/files/file_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/input_error.h"
#include "tests/fixtures/temporary_folder.h"

namespace scattermeter::capture {
namespace {

std::string refused_text(const std::string& path) {
  try {
    file_text(path, "a poem is expected");
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST(FileText, IsAllOfTheFile) {
  const TemporaryFolder folder;
  const std::string content("a\r\n\0b\n", 6);
  write_file(folder / "some.txt", content);
  write_file(folder / "empty.txt", std::string());
  EXPECT_EQ(file_text(folder / "some.txt", ""), content);
  EXPECT_EQ(file_text(folder / "empty.txt", ""), "");
}

TEST(FileText, NamesWhatIsNoFile) {
  const TemporaryFolder folder;
  EXPECT_EQ(refused_text(folder / "gone.txt"), folder / "gone.txt" + ": no such file");
  EXPECT_EQ(refused_text(folder.path()), folder.path() + ": is a folder, a poem is expected");
  EXPECT_THROW(file_text(folder / "gone.txt", ""), MissingFile);
}

}  // namespace
}  // namespace scattermeter::capture
