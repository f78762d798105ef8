#include "apps/watching/watched_folder.h"

#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/input_error.h"
#include "tests/fixtures/temporary_folder.h"

namespace scattermeter::apps {
namespace {

namespace fs = std::filesystem;

class WatchedFolderTest : public testing::Test {
 protected:
  void write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }
  // "complete a.nef", "renamed b.nef a.nef" ...
  std::vector<std::string> look() {
    static const std::map<FolderEvent, std::string> kWords = {{FolderEvent::kComplete, "complete"},
                                                              {FolderEvent::kRenamed, "renamed"},
                                                              {FolderEvent::kDoubled, "doubled"},
                                                              {FolderEvent::kGone, "gone"}};
    std::vector<std::string> out;
    for (const FolderNews& news : watched_.look()) {
      out.push_back(kWords.at(news.event) + " " + news.name +
                    (news.other.empty() ? "" : " " + news.other));
    }
    return out;
  }

  TemporaryFolder folder_;
  WatchedFolder watched_{folder_.path()};
};

using testing::ElementsAre;
using testing::IsEmpty;

TEST_F(WatchedFolderTest, TellsAFileOnceItNoLongerGrows) {
  EXPECT_THAT(look(), IsEmpty());
  write("a.nef", "half");
  EXPECT_THAT(look(), IsEmpty());
  write("a.nef", "half and half");
  EXPECT_THAT(look(), IsEmpty());
  EXPECT_THAT(look(), ElementsAre("complete a.nef"));
  EXPECT_THAT(look(), IsEmpty());
}

TEST_F(WatchedFolderTest, TellsOtherContentsUnderAnOldName) {
  write("a.nef", "one");
  look();
  look();
  write("a.nef", "another");
  EXPECT_THAT(look(), IsEmpty());
  EXPECT_THAT(look(), ElementsAre("complete a.nef"));
}

TEST_F(WatchedFolderTest, TellsCopiesNewNamesAndWhatIsGone) {
  write("a.nef", "one");
  look();
  look();
  write("copy.nef", "one");
  look();
  EXPECT_THAT(look(), ElementsAre("doubled copy.nef a.nef"));
  fs::remove(folder_ / "copy.nef");
  EXPECT_THAT(look(), IsEmpty());
  EXPECT_THAT(look(), ElementsAre("gone copy.nef"));
  fs::rename(folder_ / "a.nef", folder_ / "b.nef");
  EXPECT_THAT(look(), IsEmpty());
  EXPECT_THAT(look(), ElementsAre("renamed b.nef a.nef"));
  EXPECT_THAT(look(), IsEmpty());
  fs::remove(folder_ / "b.nef");
  look();
  EXPECT_THAT(look(), ElementsAre("gone b.nef"));
}

// A file that went before it was complete was never there.
TEST_F(WatchedFolderTest, OverlooksHiddenEmptyAndTemporaryFiles) {
  write(".hidden", "x");
  write("empty.nef", "");
  write("a.tmp", "x");
  look();
  fs::rename(folder_ / "a.tmp", folder_ / "a.nef");
  EXPECT_THAT(look(), IsEmpty());
  EXPECT_THAT(look(), ElementsAre("complete a.nef"));
  EXPECT_THAT(look(), IsEmpty());
}

TEST_F(WatchedFolderTest, RefusesWhatIsNoFolder) {
  EXPECT_THROW(WatchedFolder(folder_ / "nothing"), InputError);
  fs::remove_all(folder_.path());
  EXPECT_THROW(watched_.look(), InputError);
}

}  // namespace
}  // namespace scattermeter::apps
