#include "capture/trial_process.h"

#include <csignal>
#include <cstdlib>
#include <stdexcept>

#include <gtest/gtest.h>
#include <unistd.h>

namespace scattermeter::capture {
namespace {

TEST(TrialProcess, TellsWhetherTheWorkReturned) {
  EXPECT_TRUE(comes_back([] {}, 60));
  EXPECT_FALSE(comes_back([] { throw std::runtime_error("no"); }, 60));
  EXPECT_FALSE(comes_back([] { std::abort(); }, 60));
  EXPECT_FALSE(comes_back([] { std::raise(SIGSEGV); }, 60));
  EXPECT_FALSE(comes_back([] { _exit(0x1FF); }, 60));
}

TEST(TrialProcess, EndsWhatNeverReturns) {
  EXPECT_FALSE(comes_back(
      [] {
        while (true) pause();
      },
      1));
}

// The trial's memory and words are its own.
TEST(TrialProcess, SharesNothing) {
  int value = 1;
  testing::internal::CaptureStderr();
  EXPECT_TRUE(comes_back(
      [&value] {
        value = 2;
        ::write(STDERR_FILENO, "loud", 4);
      },
      60));
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(value, 1);
}

}  // namespace
}  // namespace scattermeter::capture
