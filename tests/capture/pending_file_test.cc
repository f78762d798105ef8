#include "capture/pending_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "core/input_error.h"
#include "tests/temporary_folder.h"

namespace scattermeter::capture {
namespace {

std::string message_of(const std::string& path) {
  try {
    PendingFile file(path);
    file.commit();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

std::string text_of(const std::string& path) {
  const std::vector<std::uint8_t> bytes = read_file(path);
  return {bytes.begin(), bytes.end()};
}

TEST(PendingFile, AppearsOnlyByCommit) {
  const TemporaryFolder folder;
  const std::string path = folder / "out.txt";
  {
    PendingFile file(path);
    ASSERT_EQ(::write(file.descriptor(), "new", 3), 3);
    EXPECT_FALSE(std::filesystem::exists(path));
    file.commit();
  }
  EXPECT_EQ(text_of(path), "new");
  EXPECT_EQ(folder.entries(), 1);
}

TEST(PendingFile, WithoutCommitLeavesWhatWasThere) {
  const TemporaryFolder folder;
  const std::string path = folder / "out.txt";
  write_file(path, std::string("old"));
  {
    PendingFile file(path);
    ASSERT_EQ(::write(file.descriptor(), "new", 3), 3);
    EXPECT_EQ(folder.entries(), 2);
  }
  EXPECT_EQ(text_of(path), "old");
  EXPECT_EQ(folder.entries(), 1);
}

TEST(PendingFile, TwoWritersOfOneNameDoNotMix) {
  const TemporaryFolder folder;
  PendingFile a(folder / "out.txt");
  PendingFile b(folder / "out.txt");
  EXPECT_NE(a.temporary_path(), b.temporary_path());
}

TEST(PendingFile, NamesTheFileThatCannotBeWritten) {
  const TemporaryFolder folder;
  const std::string lost = folder / "nowhere/out.txt";
  EXPECT_EQ(message_of(lost), lost + ": cannot be written: No such file or directory");
  const std::string occupied = folder / "occupied";
  std::filesystem::create_directory(occupied);
  EXPECT_EQ(message_of(occupied), occupied + ": cannot be written: Is a directory");
  EXPECT_EQ(folder.entries(), 1);
}

}  // namespace
}  // namespace scattermeter::capture
