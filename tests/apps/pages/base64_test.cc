#include "apps/pages/base64.h"

#include <gtest/gtest.h>

namespace scattermeter::apps {
namespace {

// RFC 4648, section 10.
TEST(Base64, TheStandardsOwnExamples) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
}

}  // namespace
}  // namespace scattermeter::apps
