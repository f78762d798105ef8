#include "calib/board/opencv_quiet.h"

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

namespace scattermeter::calib {
namespace {

int calls = 0;
int count_call(int, const char*, const char*, const char*, int, void* data) {
  ++calls;
  ++*static_cast<int*>(data);
  return 0;
}

void fail_in_opencv() { CV_Error(cv::Error::StsError, "on purpose"); }

TEST(OpencvQuiet, SilentWhileItLivesAndRestoredAfter) {
  int mine = 0;
  cv::redirectError(&count_call, &mine);
  {
    const OpencvQuiet outer;
    const OpencvQuiet inner;
    ::testing::internal::CaptureStderr();
    EXPECT_THROW(fail_in_opencv(), cv::Exception);
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
    EXPECT_EQ(calls, 0);
  }
  EXPECT_THROW(fail_in_opencv(), cv::Exception);
  EXPECT_EQ(calls, 1);
  EXPECT_EQ(mine, 1);  // with its data, too
  cv::redirectError(nullptr);
}

}  // namespace
}  // namespace scattermeter::calib
