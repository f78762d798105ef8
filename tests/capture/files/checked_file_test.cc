#include "capture/files/checked_file.h"

#include <fstream>
#include <iterator>
#include <string>

#include <gtest/gtest.h>

#include "core/base/input_error.h"
#include "tests/fixtures/temporary_folder.h"

namespace scattermeter::capture {
namespace {

TEST(CheckedFile, ComesBack) {
  const TemporaryFolder folder;
  const std::string path = folder / "a/b";
  EXPECT_FALSE(read_checked_file(path));
  for (const std::string& content : {std::string("seven\0bytes", 11), std::string()}) {
    write_checked_file(path, content);
    EXPECT_EQ(read_checked_file(path), content);
  }
  EXPECT_THROW(write_checked_file(path + "/c", "x"), InputError);
}

TEST(CheckedFile, IsNotThereIfDamaged) {
  const TemporaryFolder folder;
  const std::string path = folder / "a";
  write_checked_file(path, "content");
  std::string bytes;
  {
    std::ifstream in(path, std::ios::binary);
    bytes.assign((std::istreambuf_iterator<char>(in)), {});
  }
  for (const std::string& other : {bytes.substr(0, bytes.size() - 1), bytes + "x",
                                   "0" + bytes.substr(1), bytes.substr(0, 20)}) {
    if (other == bytes) continue;
    std::ofstream(path, std::ios::binary) << other;
    EXPECT_FALSE(read_checked_file(path)) << other;
  }
}

}  // namespace
}  // namespace scattermeter::capture
