#include "apps/drafting/listed_numbers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/input_error.h"

namespace scattermeter::apps {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

TEST(ListedNumbers, AreThoseBetweenTheSeparators) {
  EXPECT_THAT(listed_numbers("30x2.5x1e1", 'x', "--body", ""), ElementsAre(30.0, 2.5, 10.0));
  EXPECT_THAT(listed_numbers("-60,80", ',', "--led", ""), ElementsAre(-60.0, 80.0));
  EXPECT_THAT(listed_numbers("", ',', "--led", ""), ElementsAre());
}

TEST(ListedNumbers, NamesWhatIsNone) {
  for (const char* text : {"30xa", "xx", "30x", "1e999", "nan", "3 0", "inf"}) {
    EXPECT_THAT([&] { listed_numbers(text, 'x', "--body", "box:" + std::string(text)); },
                ThrowsMessage<InputError>(::testing::AllOf(
                    HasSubstr("--body"), HasSubstr("got box:" + std::string(text)))))
        << text;
  }
}

}  // namespace
}  // namespace scattermeter::apps
