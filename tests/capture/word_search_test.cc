#include "capture/word_search.h"

#include <fstream>

#include <gtest/gtest.h>

#include "core/input_error.h"
#include "tests/temporary_folder.h"

namespace scattermeter::capture {
namespace {

using namespace std::string_literals;

class WordSearch : public testing::Test {
 protected:
  bool says(const std::string& bytes) const {
    std::ofstream(path_, std::ios::binary) << bytes;
    return says_word(path_, "hasselblad");
  }
  TemporaryFolder folder_;
  std::string path_ = folder_ / "shot.dng";
};

TEST_F(WordSearch, InAnyLettersOfOneOrTwoBytes) {
  EXPECT_TRUE(says("Hasselblad"));
  EXPECT_TRUE(says("...HASSELBLAD\0..."s));
  EXPECT_TRUE(says("xH\0a\0s\0s\0e\0L\0b\0l\0a\0d\0y"s));
  EXPECT_FALSE(says(""));
  EXPECT_FALSE(says("Hasselbla"));
  EXPECT_FALSE(says("Hassel blad"));
  EXPECT_FALSE(says("H\0assel\0blad"s));
  EXPECT_FALSE(says("Hassan, ein Hasse, hasselbl\x01"s + "d"));
}

// Over the edges of what is read at once, too.
TEST_F(WordSearch, AnywhereInTheFile) {
  constexpr std::size_t kEdge = std::size_t{1} << 20U;
  for (std::size_t before = kEdge - 22; before <= kEdge + 22; ++before) {
    EXPECT_TRUE(says(std::string(before, 'h') + "hasselblad")) << before;
    EXPECT_TRUE(says(std::string(before, 's') + "H\0a\0s\0s\0e\0l\0b\0l\0a\0d\0 tail"s)) << before;
  }
  EXPECT_TRUE(says(std::string(3 * kEdge, 'h') + "hasselblad"));
  EXPECT_FALSE(says(std::string(3 * kEdge, 'h') + "hasselblat"));
}

TEST_F(WordSearch, NamesAFileThatIsNotThere) {
  EXPECT_THROW(says_word(folder_ / "nowhere.dng", "word"), InputError);
}

}  // namespace
}  // namespace scattermeter::capture
