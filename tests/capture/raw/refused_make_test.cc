#include "capture/raw/refused_make.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/input_error.h"
#include "tests/fixtures/temporary_folder.h"

namespace scattermeter::capture {
namespace {

using namespace std::string_literals;

class RefusedMake : public testing::Test {
 protected:
  bool refused(const std::string& bytes) const {
    write_file(path_, bytes);
    try {
      refuse_unsafe_make(path_);
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), testing::StartsWith(path_ + ": contains the name Hasselblad"));
      return true;
    }
    return false;
  }
  TemporaryFolder folder_;
  std::string path_ = folder_ / "shot.dng";
};

TEST_F(RefusedMake, InLettersOfEitherCaseAndOfOneOrTwoBytes) {
  EXPECT_TRUE(refused("Hasselblad"));
  EXPECT_TRUE(refused("...HASSELBLAD\0..."s));
  EXPECT_TRUE(refused("xH\0a\0s\0s\0e\0L\0b\0l\0a\0d\0y"s));
  EXPECT_FALSE(refused(""));
  EXPECT_FALSE(refused("Hasselbla"));
  EXPECT_FALSE(refused("Hassel blad"));
  EXPECT_FALSE(refused("H\0assel\0blad"s));
  EXPECT_FALSE(refused("Hassan, ein Hasse, hasselbl\x01"s + "d"));
}

// Also across the borders of the chunks that are read at once.
TEST_F(RefusedMake, AnywhereInTheFile) {
  constexpr std::size_t kEdge = std::size_t{1} << 20U;
  for (std::size_t before = kEdge - 22; before <= kEdge + 22; ++before) {
    EXPECT_TRUE(refused(std::string(before, 'h') + "hasselblad")) << before;
    EXPECT_TRUE(refused(std::string(before, 's') + "H\0a\0s\0s\0e\0l\0b\0l\0a\0d\0 tail"s))
        << before;
  }
  EXPECT_TRUE(refused(std::string(3 * kEdge, 'h') + "hasselblad"));
  EXPECT_FALSE(refused(std::string(3 * kEdge, 'h') + "hasselblat"));
}

TEST_F(RefusedMake, NamesAMissingFile) {
  EXPECT_THROW(refuse_unsafe_make(folder_ / "nowhere.dng"), InputError);
}

}  // namespace
}  // namespace scattermeter::capture
