#include "apps/commands/questions.h"

#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/input_error.h"

namespace scattermeter::apps {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

void only_numbers(const std::vector<std::string>& words) {
  for (const std::string& word : words) {
    if (word.find_first_not_of("0123456789") != std::string::npos) {
      throw InputError("--n", "expected a number, got " + word);
    }
  }
}

TEST(Questions, TakesWordsAndAnEmptyLineForTheDefault) {
  std::istringstream in("  3 4\n\n");
  std::ostringstream out;
  Questions questions(in, out);
  EXPECT_THAT(questions.ask("Which numbers?", {"1", "2"}, only_numbers), ElementsAre("3", "4"));
  EXPECT_THAT(questions.ask("And which?", {"1", "2"}, only_numbers), ElementsAre("1", "2"));
  EXPECT_THAT(out.str(), HasSubstr("Which numbers? [1 2]: "));
}

TEST(Questions, AsksAgainAndEndsWithTheInput) {
  std::istringstream in("3 four\n5\n");
  std::ostringstream out;
  Questions questions(in, out);
  EXPECT_THAT(questions.ask("Which?", {"1"}, only_numbers), ElementsAre("5"));
  EXPECT_THAT(out.str(), HasSubstr("got four"));
  EXPECT_THAT(questions.ask("Which?", {"1"}, only_numbers), ElementsAre("1"));
}

TEST(Questions, ChecksTheDefaultAsWell) {
  std::istringstream in("\n5\n");
  std::ostringstream out;
  Questions questions(in, out);
  EXPECT_THAT(questions.ask("Which?", {"one"}, only_numbers), ElementsAre("5"));
  EXPECT_THAT(out.str(), HasSubstr("got one"));
}

}  // namespace
}  // namespace scattermeter::apps
