#include "apps/report/child_process.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "capture/files/pending_file.h"
#include "tests/fixtures/apps/small_rig.h"
#include "tests/fixtures/temporary_folder.h"

namespace scattermeter::apps {
namespace {

class ChildProcess : public ::testing::Test {
 protected:
  ChildResult child(const std::vector<std::string>& words, const std::string& input) {
    capture::PendingFile file(folder_ / "out");
    const ChildResult result = run_child(words, input, file.descriptor());
    file.commit();
    return result;
  }
  TemporaryFolder folder_;
};

TEST_F(ChildProcess, InputGoesThrough) {
  const std::string input(1 << 20, 'x');  // more than a pipe holds
  EXPECT_EQ(child({"cat"}, input).status, 0);
  EXPECT_TRUE(slurp(folder_ / "out") == input);
}

TEST_F(ChildProcess, StatusAndErrors) {
  const ChildResult r = child({"sh", "-c", "echo \"$0\" >&2; exit 3", "it's $HOME"}, "unread");
  EXPECT_EQ(r.status, 3);
  EXPECT_EQ(r.errors, "it's $HOME");
  EXPECT_EQ(child({"sh", "-c", "kill -9 $$"}, std::string(1 << 20, 'x')).status, 128 + 9);
}

TEST_F(ChildProcess, ProgramThatIsNotThere) {
  const ChildResult r = child({"no-such-program-anywhere"}, "");
  EXPECT_EQ(r.status, ChildResult::kNotStarted);
  EXPECT_THAT(r.errors, ::testing::HasSubstr("No such file"));
}

}  // namespace
}  // namespace scattermeter::apps
