#include "apps/program/progress_bar.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scattermeter::apps {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;

TEST(ProgressBar, DrawsEachStepAndIsErased) {
  ProgressBar bar;
  ::testing::internal::CaptureStderr();
  bar.begin("reading shots", 2);
  bar.step();
  const std::string half = ::testing::internal::GetCapturedStderr();
  EXPECT_THAT(half, HasSubstr("\rreading shots          [                              ] 0/2"));
  EXPECT_THAT(half, EndsWith("\rreading shots          [###############               ] 1/2"));
  ::testing::internal::CaptureStderr();
  bar.step();
  bar.end();
  EXPECT_EQ(::testing::internal::GetCapturedStderr(),
            "\rreading shots          [##############################] 2/2\r\033[K");
  // The next stage starts anew.
  ::testing::internal::CaptureStderr();
  bar.begin("fit", 4);
  EXPECT_THAT(::testing::internal::GetCapturedStderr(), HasSubstr("] 0/4"));
}

TEST(ProgressBar, NothingToDoDrawsNothing) {
  ProgressBar bar;
  ::testing::internal::CaptureStderr();
  bar.begin("none", 0);
  bar.step();
  bar.end();
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace scattermeter::apps
