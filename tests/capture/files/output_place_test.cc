#include "capture/files/output_place.h"

#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "core/base/input_error.h"
#include "tests/fixtures/temporary_folder.h"

namespace scattermeter::capture {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

template <typename Call>
std::string refusal_of(const Call& call) {
  try {
    call();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(OutputPlace, NothingIsCreated) {
  const TemporaryFolder folder;
  EXPECT_EQ(refusal_of([&] { require_output_folder(folder.path()); }), "");
  EXPECT_EQ(refusal_of([&] { require_output_folder(folder / "a/b/c"); }), "");
  EXPECT_EQ(refusal_of([&] { require_output_folder(folder / "a/"); }), "");
  EXPECT_EQ(refusal_of([&] { require_output_file(folder / "a/file.yaml"); }), "");
  EXPECT_EQ(refusal_of([&] { require_output_folder("result"); }), "");
  EXPECT_EQ(refusal_of([&] { require_output_file("file.yaml"); }), "");
  EXPECT_EQ(folder.entries(), 0);
}

TEST(OutputPlace, AFileInTheWay) {
  const TemporaryFolder folder;
  const std::string file = folder / "a";
  write_file(file, std::string("text"));
  EXPECT_EQ(refusal_of([&] { require_output_folder(file); }),
            file + ": is a file, a folder is needed for the results");
  EXPECT_EQ(refusal_of([&] { require_output_folder(file + "/b"); }),
            file + "/b: cannot be created: " + file + " is a file");
  EXPECT_EQ(refusal_of([&] { require_output_file(file); }), "");  // will be replaced
  EXPECT_THAT(refusal_of([&] { require_output_file(folder.path()); }), HasSubstr("is a folder"));
}

TEST(OutputPlace, NoInputIsReplaced) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "shots");
  for (const char* name : {"rig.yaml", "shots/a.dng", "shots/camera.yaml"}) {
    write_file(folder / name, std::string("text"));
  }
  const std::vector<std::string> inputs = {folder / "rig.yaml", folder / "shots", ""};
  const auto refusal = [&](const std::string& out) {
    return refusal_of([&] { require_output_file(out, inputs); });
  };
  for (const char* name : {"rig.yaml", "shots/../rig.yaml", "shots/a.dng"}) {
    EXPECT_EQ(
        refusal(folder / name),
        "--out: is one of the files that are read, and would be replaced: " + (folder / name));
  }
  EXPECT_EQ(refusal(folder / "camera.yaml"), "");
  EXPECT_EQ(refusal(folder / "shots/b.dng"), "");
  EXPECT_EQ(refusal(folder / "shots/camera.yaml"), "");  // of a calibration before
}

TEST(OutputPlace, AnEmptyName) {
  EXPECT_EQ(refusal_of([] { require_output_file(""); }),
            "--out: is empty, the name of a file is needed");
  EXPECT_EQ(refusal_of([] { require_output_folder(""); }),
            "--out: is empty, the name of a folder is needed");
}

TEST(OutputPlace, AFolderThatCannotBeWritten) {
  // The superuser may write anywhere but into the kernel's own file systems.
  const std::string closed = ::geteuid() == 0 ? "/proc/1" : "/";
  if (::access(closed.c_str(), W_OK) == 0) GTEST_SKIP() << closed << " can be written here";
  EXPECT_THAT(refusal_of([&] { require_output_folder(closed + "/out"); }),
              StartsWith(closed + "/out: cannot be written: "));
}

TEST(OutputPlace, SameFolderByAnotherName) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "shots");
  std::filesystem::create_directory_symlink(folder / "shots", folder / "link");
  EXPECT_TRUE(is_same_folder(folder / "shots", folder / "shots/"));
  EXPECT_TRUE(is_same_folder(folder / "shots", folder / "link"));
  EXPECT_FALSE(is_same_folder(folder / "shots", folder.path()));
  EXPECT_FALSE(is_same_folder(folder / "shots", folder / "nowhere"));
}

}  // namespace
}  // namespace scattermeter::capture
