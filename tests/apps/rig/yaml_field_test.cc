#include "apps/rig/yaml_field.h"

#include <filesystem>
#include <functional>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/input_error.h"
#include "tests/fixtures/temporary_folder.h"

namespace scattermeter::apps {
namespace {

YamlField load(const TemporaryFolder& folder, const std::string& text) {
  write_file(folder / "a.yaml", text);
  return YamlField::load(folder / "a.yaml");
}

TEST(YamlField, ReadsValues) {
  const TemporaryFolder folder;
  const YamlField top = load(folder, "a: 1.5\nb: [1, 2, 3]\nc: text\nd: {e: 7}\n");
  top.only({"a", "b", "c", "d"});
  EXPECT_EQ(top.at("a").number(), 1.5);
  EXPECT_EQ(top.at("b").vector3(), Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(top.at("c").text(), "text");
  EXPECT_EQ(top.at("d").at("e").integer(0, 10), 7);
  EXPECT_EQ(top.at("d").at("e").path(), "d.e");
  EXPECT_EQ(top.at("c").line(), 3);
  EXPECT_FALSE(top.find("z").has_value());
}

void expect_message(const std::function<void()>& f, const std::string& message) {
  try {
    f();
    FAIL() << "nothing thrown, wanted: " << message;
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), ::testing::HasSubstr(message));
  }
}

TEST(YamlField, NamesPlaceAndValue) {
  const TemporaryFolder folder;
  const YamlField top = load(folder, "a: x\nb: [1, y]\nc: 3\nd:\nc2: 2.5\n");
  expect_message([&] { top.at("a").number(); }, "a.yaml:1: a: expected a number, got x");
  expect_message([&] { top.at("b").numbers(2); }, "a.yaml:2: b[1]: expected a number, got y");
  expect_message([&] { top.at("c").number(4, 5); }, "c: expected a number from 4 to 5, got 3");
  expect_message([&] { top.at("c").number(4); }, "of at least 4");
  expect_message([&] { top.at("d").text(); }, "d: expected text, got nothing");
  expect_message([&] { top.at("c2").integer(0, 9); }, "integer, got 2.5");
  expect_message([&] { top.at("q"); }, "q: is missing");
  expect_message([&] { top.only({"a", "b", "c", "d"}); }, "a.yaml:5: c2: unknown key");
  expect_message([&] { top.at("a").items(); }, "expected a list");
  expect_message([&] { top.at("a").entries(); }, "expected a map");
}

TEST(YamlField, RefusesWhatIsNoMap) {
  const TemporaryFolder folder;
  expect_message([&] { load(folder, "- 1\n- 2\n"); }, "map at the top");
  expect_message([&] { load(folder, ""); }, "map at the top");
  expect_message([&] { load(folder, "a: [1, 2\nb: 3"); }, "not valid YAML");
}

// What the system refuses to look up is a file that can't be read, no error of another kind.
TEST(YamlField, NamesThatTheSystemRefuses) {
  const TemporaryFolder folder;
  expect_message([&] { YamlField::load(folder / std::string(5000, 'a')); }, "cannot be opened");
  std::filesystem::create_symlink("loop.yaml", std::filesystem::path(folder / "loop.yaml"));
  expect_message([&] { YamlField::load(folder / "loop.yaml"); }, "cannot be opened");
  expect_message([&] { YamlField::load(folder / "."); }, "is a folder");
}

}  // namespace
}  // namespace scattermeter::apps
