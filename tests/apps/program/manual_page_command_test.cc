// The manual page and bash's completion hold what --help holds.
#include <regex>
#include <set>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "apps/report/child_process.h"
#include "tests/fixtures/apps/small_rig.h"
#include "tests/fixtures/temporary_folder.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

using Words = std::vector<std::string>;

std::string help_of(Words command) {
  command.emplace_back("--help");
  return run(command).out;
}

// Every --option of a command's help.
std::set<std::string> options_in_help(const Words& command) {
  const std::string help = help_of(command);
  std::set<std::string> out;
  const std::regex pattern("(^|[ ,])(--[a-z][a-z-]*)", std::regex::multiline);
  for (auto it = std::sregex_iterator(help.begin(), help.end(), pattern);
       it != std::sregex_iterator(); ++it) {
    out.insert((*it)[2]);
  }
  return out;
}

const std::vector<Words> kCommands = {
    {},           {"measure"}, {"check"},  {"calibrate"}, {"calibrate", "led"},
    {"simulate"}, {"render"},  {"export"}, {"bench"}};

TEST(ManualPageCommand, HoldsEveryOptionOfEveryCommand) {
  const Answer answer = run({"manual-page"});
  EXPECT_EQ(answer.status, 0) << answer.err;
  const Answer of_bench = run({"manual-page", "--bench"});
  EXPECT_EQ(of_bench.status, 0) << of_bench.err;
  const std::string man = std::regex_replace(answer.out + of_bench.out, std::regex(R"(\\-)"), "-");
  std::size_t met = 0;
  for (const Words& command : kCommands) {
    for (const std::string& option : options_in_help(command)) {
      ++met;
      EXPECT_THAT(man, HasSubstr("\\fB" + option + "\\fR"));
    }
    for (const std::string& word : command) EXPECT_THAT(man, HasSubstr(word));
  }
  EXPECT_GT(met, 40U);
  EXPECT_THAT(man, HasSubstr(".TH SCATTERMETER 1"));
  EXPECT_THAT(man, HasSubstr(".SS \"scattermeter calibrate led"));
  EXPECT_THAT(answer.out, ::testing::Not(HasSubstr("bench deviations")));
  EXPECT_THAT(of_bench.out, HasSubstr("both|dipole|volume"));
  EXPECT_THAT(of_bench.out, HasSubstr(".SS \"scattermeter bench deviations"));
  for (const char* section : {"EXIT STATUS", "EXAMPLES", "FILES", "SEE ALSO"}) {
    EXPECT_THAT(answer.out, HasSubstr(std::string("\n.SH ") + section + "\n"));
  }
  // No line of text that roff takes for a request.
  EXPECT_FALSE(std::regex_search(man, std::regex("\n\\.(?!TH|SH|SS|TP|B|br)")));
  // It is no command for users.
  EXPECT_THAT(run({"--help"}).out, ::testing::Not(HasSubstr("manual-page")));
  EXPECT_EQ(run({"manual-page", "fish"}).status, 2);
}

// Bash itself completes each of the lines; a function stands for the program and prints its help.
std::string completed(const std::vector<std::string>& lines) {
  const TemporaryFolder folder;
  std::vector<Words> commands = kCommands;
  commands.push_back({"measure", "shots"});
  for (const Words& command : commands) {
    std::string name;
    for (const std::string& word : command) name += word + " ";
    write_file(folder / (name + "--help"), help_of(command));
  }
  std::string script = R"sh(
source "$1/apps/program/scattermeter.bash"
folder=$2
scattermeter() { cat "$folder/$*"; }
try() { COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _scattermeter; echo "$*:${COMPREPLY[*]}"; }
)sh";
  for (const std::string& line : lines) script += "try scattermeter " + line + "\n";
  write_file(folder / "try", script);
  const int descriptor = ::open((folder / "out").c_str(), O_CREAT | O_WRONLY, 0600);
  const ChildResult child =
      run_child({"bash", folder / "try", SCATTERMETER_SOURCE_DIR, folder.path()}, "", descriptor);
  ::close(descriptor);
  EXPECT_EQ(child.status, 0) << child.errors;
  return slurp(folder / "out");
}

TEST(BashCompletion, CompletesCommandsOptionsAndChoices) {
  EXPECT_EQ(completed({"me", "-q calibrate ''", "calibrate led --li", "measure --thr",
                       "measure shots --rig rig.yaml --model t", "export result.json --format ma",
                       "measure --out res"}),
            "scattermeter me:measure\n"
            "scattermeter -q calibrate :camera led radiance\n"
            "scattermeter calibrate led --li:--light\n"
            "scattermeter measure --thr:--threads\n"
            "scattermeter measure shots --rig rig.yaml --model t:transport\n"
            "scattermeter export result.json --format ma:materialx\n"
            "scattermeter measure --out res:\n");  // files: left to bash
}

// Those that the command itself lists; its help names others in prose.
TEST(BashCompletion, OffersEveryOptionOfEveryCommand) {
  std::size_t met = 0;
  for (const Words& command : kCommands) {
    std::string line;
    for (const std::string& word : command) line += word + " ";
    const std::string offered = completed({line + "--"});
    const std::string help = "\n" + help_of(command);
    for (const std::string& option : options_in_help(command)) {
      if (!std::regex_search(help, std::regex("\n  (-[a-z],)?" + option + "[ \n]"))) continue;
      ++met;
      EXPECT_THAT(offered, ::testing::ContainsRegex("[ :]" + option + "[ \n]"));
    }
  }
  EXPECT_GT(met, 40U);
}

}  // namespace
}  // namespace scattermeter::apps
