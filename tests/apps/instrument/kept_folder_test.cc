#include "apps/instrument/kept_folder.h"

#include <chrono>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "tests/fixtures/temporary_folder.h"

namespace scattermeter::apps {
namespace {

namespace fs = std::filesystem;

std::string file_of(const TemporaryFolder& folder, const std::string& name) {
  return folder / ("deep/" + name + ".kept");
}

// Nothing is written before write().
TEST(KeptFolder, FindsWhatAnotherKept) {
  const TemporaryFolder folder;
  KeptFolder one(folder / "deep", ".kept"), other(folder / "deep", ".kept");
  EXPECT_FALSE(one.find("a"));
  one.keep("a", "content");
  EXPECT_FALSE(fs::exists(folder / "deep"));
  EXPECT_EQ(one.write(), "");
  EXPECT_EQ(other.find("a"), "content");
  EXPECT_FALSE(other.find("b"));
}

TEST(KeptFolder, DoesNotBelieveADamagedFile) {
  const TemporaryFolder folder;
  KeptFolder files(folder / "deep", ".kept");
  files.keep("a", "content");
  files.write();
  const std::string path = file_of(folder, "a");
  fs::resize_file(path, fs::file_size(path) - 4);
  EXPECT_FALSE(files.find("a"));
}

// Room for two and a half: of three, that which was used last stays.
TEST(KeptFolder, RemovesWhatWasNotUsedForLongest) {
  const TemporaryFolder folder;
  const std::string content(40000, 'x');
  KeptFolder files(folder / "deep", ".kept", 100000);
  const auto age = [&](const std::string& name, int hours) {
    fs::last_write_time(file_of(folder, name),
                        fs::file_time_type::clock::now() - std::chrono::hours(hours));
  };
  files.keep("a", content);
  files.write();
  age("a", 2);
  files.keep("b", content);
  files.write();
  age("b", 1);
  EXPECT_TRUE(files.find("a"));
  files.keep("c", content);
  files.write();
  EXPECT_TRUE(files.find("a"));
  EXPECT_FALSE(files.find("b"));
  EXPECT_TRUE(files.find("c"));
}

TEST(KeptFolder, SaysWhyItCannotKeep) {
  KeptFolder files("/proc/none", ".kept");
  files.keep("a", "content");
  EXPECT_NE(files.write(), "");
  EXPECT_EQ(files.write(), "");
}

}  // namespace
}  // namespace scattermeter::apps
