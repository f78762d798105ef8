#include "core/base/utf8.h"

#include <string>

#include <gtest/gtest.h>

namespace scattermeter {
namespace {

TEST(Utf8, CharactersOfEveryLength) {
  for (const std::string text : {"", "rig", "Größe", "\u20AC", "\U0001F4A1", "\U0010FFFF"}) {
    EXPECT_EQ(first_no_utf8(text), text.size()) << text;
  }
}

TEST(Utf8, NamesTheFirstByteThatIsNone) {
  EXPECT_EQ(first_no_utf8("Gr\xF6\xDF"
                          "e"),
            2U);                                         // Latin-1
  EXPECT_EQ(first_no_utf8("a\xC3"), 1U);                 // ends within a character
  EXPECT_EQ(first_no_utf8("\x80"), 0U);                  // a continuation alone
  EXPECT_EQ(first_no_utf8("ab\xC0\xAF"), 2U);            // not the shortest form
  EXPECT_EQ(first_no_utf8("\xED\xA0\x80"), 0U);          // a surrogate
  EXPECT_EQ(first_no_utf8("\xF4\x90\x80\x80"), 0U);      // above U+10FFFF
  EXPECT_EQ(first_no_utf8("\xF8\x88\x80\x80\x80"), 0U);  // five bytes
}

}  // namespace
}  // namespace scattermeter
