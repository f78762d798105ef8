// The manual and the completions hold what --help holds.
#include <filesystem>
#include <regex>
#include <set>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "apps/child_process.h"
#include "tests/apps/small_rig.h"
#include "tests/temporary_folder.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

// Every --option of a command's help.
std::set<std::string> options_in_help(const std::vector<std::string>& command) {
  std::vector<std::string> words = command;
  words.emplace_back("--help");
  const std::string help = run(words).out;
  std::set<std::string> out;
  const std::regex pattern("(^|[ ,])(--[a-z][a-z-]*)", std::regex::multiline);
  for (auto it = std::sregex_iterator(help.begin(), help.end(), pattern);
       it != std::sregex_iterator(); ++it) {
    out.insert((*it)[2]);
  }
  return out;
}

const std::vector<std::vector<std::string>> kCommands = {
    {},           {"measure"}, {"check"},  {"calibrate"}, {"calibrate", "led"},
    {"simulate"}, {"render"},  {"export"}, {"bench"}};

std::string page(const std::string& what) {
  const Answer answer = run({"pages", what});
  EXPECT_EQ(answer.status, 0) << answer.err;
  return answer.out;
}

TEST(CommandPages, HoldEveryOptionOfEveryCommand) {
  const std::string man = std::regex_replace(page("man"), std::regex(R"(\\-)"), "-");
  const std::string bash = page("bash");
  const std::string zsh = page("zsh");
  std::size_t met = 0;
  for (const auto& command : kCommands) {
    for (const std::string& option : options_in_help(command)) {
      ++met;
      EXPECT_THAT(man, HasSubstr("\\fB" + option + "\\fR"));
      EXPECT_THAT(bash, ::testing::ContainsRegex("[ ']" + option + "[ ']"));
      EXPECT_THAT(zsh, HasSubstr("'*" + option + "["));
    }
    for (const std::string& word : command) EXPECT_THAT(man, HasSubstr(word));
  }
  EXPECT_GT(met, 40U);
  EXPECT_THAT(man, HasSubstr(".TH SCATTERMETER 1"));
  EXPECT_THAT(man, HasSubstr(".SS \"scattermeter calibrate led"));
  // No line of text that roff takes for a request.
  EXPECT_FALSE(std::regex_search(man, std::regex("\n\\.(?!TH|SH|SS|TP|B|br)")));
  // It is no command for users.
  EXPECT_THAT(run({"--help"}).out, ::testing::Not(HasSubstr("pages")));
  EXPECT_EQ(run({"pages", "fish"}).status, 2);
}

// bash itself completes.
TEST(CommandPages, BashCompletes) {
  const TemporaryFolder folder;
  write_file(folder / "completion", page("bash"));
  write_file(folder / "try", std::string(R"sh(
source "$1/completion"
try() { COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _scattermeter; echo "$*:${COMPREPLY[*]}"; }
try scattermeter me
try scattermeter -q calibrate ""
try scattermeter calibrate led --li
try scattermeter measure --thr
try scattermeter measure shots --rig rig.yaml --model t
try scattermeter export result.json --format ma
try scattermeter measure --out res
)sh"));
  const int descriptor = ::open((folder / "out").c_str(), O_CREAT | O_WRONLY, 0600);
  const ChildResult child = run_child({"bash", folder / "try", folder.path()}, "", descriptor);
  ::close(descriptor);
  ASSERT_EQ(child.status, 0) << child.errors;
  EXPECT_EQ(slurp(folder / "out"),
            "scattermeter me:measure\n"
            "scattermeter -q calibrate :camera led radiance\n"
            "scattermeter calibrate led --li:--light\n"
            "scattermeter measure --thr:--threads\n"
            "scattermeter measure shots --rig rig.yaml --model t:transport\n"
            "scattermeter export result.json --format ma:materialx\n"
            "scattermeter measure --out res:\n");  // files: left to bash
}

TEST(CommandPages, ZshReadsItsScript) {
  if (!std::filesystem::exists("/bin/zsh")) GTEST_SKIP() << "zsh is not installed";
  const TemporaryFolder folder;
  write_file(folder / "_scattermeter", page("zsh"));
  const int descriptor = ::open("/dev/null", O_WRONLY);
  const ChildResult child = run_child({"/bin/zsh", "-n", folder / "_scattermeter"}, "", descriptor);
  ::close(descriptor);
  EXPECT_EQ(child.status, 0) << child.errors;
}

}  // namespace
}  // namespace scattermeter::apps
