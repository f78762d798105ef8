#include "capture/shots/shot_folder.h"

#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/input_error.h"
#include "tests/fixtures/temporary_folder.h"

namespace scattermeter::capture {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class ShotFolderTest : public ::testing::Test {
 protected:
  ShotFolderTest() {
    scene_.source = "rig.yaml";
    scene_.shots.resize(2);
    scene_.shots[0].file = "b.dng";
    scene_.shots[0].line = 7;
    scene_.shots[1].file = "a.dng";
    scene_.shots[1].more_files = {"a2.dng"};
    scene_.shots[1].line = 9;
  }

  void put(const std::string& name) const { write_file(folder_ / name, std::string("x")); }

  std::string refusal(const std::string& path) const {
    try {
      match_shots(scene_, {}, path);
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  }

  Scene scene_;
  TemporaryFolder folder_;
};

TEST_F(ShotFolderTest, PathsAreInTheScenesOrder) {
  for (const char* name : {"a.dng", "a2.dng", "b.dng", "z.dng", "notes.txt", "board.dng", ".x"}) {
    put(name);
  }
  std::filesystem::create_directory(folder_ / "results");
  const ShotFolder found = match_shots(scene_, {"board.dng", "not there.dng"}, folder_.path());
  EXPECT_THAT(found.paths, ElementsAre(ElementsAre(folder_ / "b.dng"),
                                       ElementsAre(folder_ / "a.dng", folder_ / "a2.dng")));
  EXPECT_THAT(found.unlisted, ElementsAre("notes.txt", "z.dng"));
}

TEST_F(ShotFolderTest, NamesEveryMissingFile) {
  put("b.dng");
  EXPECT_THROW(match_shots(scene_, {}, folder_.path()), MissingFile);
  EXPECT_THAT(refusal(folder_.path()), HasSubstr("rig.yaml:9: shots.file"));
  EXPECT_THAT(refusal(folder_.path()), HasSubstr("a.dng, a2.dng"));
  put("a.dng");
  put("A2.DNG");
  EXPECT_THAT(refusal(folder_.path()), HasSubstr(": a2.dng; did you mean A2.DNG?"));
}

TEST_F(ShotFolderTest, RefusesWhatIsNotAFolderOfShots) {
  EXPECT_THAT(refusal(folder_.path()), HasSubstr("is empty"));
  EXPECT_THAT(refusal(folder_ / "nowhere"), HasSubstr("does not exist"));
  std::filesystem::create_directory(folder_ / "100NIKON");
  EXPECT_THAT(refusal(folder_.path()), HasSubstr("holds no file, but the folder 100NIKON"));
  put("file");
  EXPECT_THAT(refusal(folder_ / "file"), HasSubstr("is a file"));
}

}  // namespace
}  // namespace scattermeter::capture
