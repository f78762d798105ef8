#include "capture/raw/ifd_bytes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scattermeter::capture {
namespace {

using testing::ElementsAre;

IfdBytes example(ByteOrder order) {
  IfdBytes directory(order);
  directory.shorts(0x0102, {8});
  directory.undefined(0x0203, {1, 2, 3, 4, 5});
  directory.ascii(0x0304, "abc");
  directory.rationals(0x0405, {{1, 258}});
  return directory;
}

TEST(IfdBytes, LittleEndian) {
  EXPECT_THAT(example(ByteOrder::kLittleEndian).at(8),
              ElementsAre(4, 0,                                            // entries
                          0x02, 0x01, 3, 0, 1, 0, 0, 0, 8, 0, 0, 0,        // in the entry
                          0x03, 0x02, 7, 0, 5, 0, 0, 0, 62, 0, 0, 0,       // at 8 + 54
                          0x04, 0x03, 2, 0, 4, 0, 0, 0, 'a', 'b', 'c', 0,  // with its 0
                          0x05, 0x04, 5, 0, 1, 0, 0, 0, 68, 0, 0, 0,       // at an even offset
                          0, 0, 0, 0,                                      // no next
                          1, 2, 3, 4, 5, 0, 1, 0, 0, 0, 2, 1, 0, 0));
}

TEST(IfdBytes, BigEndian) {
  EXPECT_THAT(example(ByteOrder::kBigEndian).at(0x108),
              ElementsAre(0, 4,                                            //
                          0x01, 0x02, 0, 3, 0, 0, 0, 1, 0, 8, 0, 0,        // left in its entry
                          0x02, 0x03, 0, 7, 0, 0, 0, 5, 0, 0, 1, 0x3e,     //
                          0x03, 0x04, 0, 2, 0, 0, 0, 4, 'a', 'b', 'c', 0,  //
                          0x04, 0x05, 0, 5, 0, 0, 0, 1, 0, 0, 1, 0x44,     //
                          0, 0, 0, 0,                                      //
                          1, 2, 3, 4, 5, 0, 0, 0, 0, 1, 0, 0, 1, 2));
}

}  // namespace
}  // namespace scattermeter::capture
