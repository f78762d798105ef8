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
  expect_message([&] { load(folder, "a: {b: 'c, d: 1}\ne: {f: 'g'}\n"); },
                 "is a bracket or quote on this line or above left open?");
  expect_message([&] { load(folder, std::string("II*\0\b\xc2", 6)); }, "not a text file");
}

TEST(YamlField, SuggestsTheKeyThatWasMeant) {
  const TemporaryFolder folder;
  const YamlField top = load(folder, "camera: 1\nlihgts: 2\n");
  expect_message(
      [&] {
        top.only({"camera", "lights", "shots"});
      },
      "a.yaml:2: lihgts: unknown key; did you mean lights? (known here: camera, lights,");
}

TEST(YamlField, TabsAndTheirLine) {
  const TemporaryFolder folder;
  for (const char* text : {"a:\n  b: 1\n\tc: 2\n", "a: 1\nb:\n\tc: 2\n", "a:\n  - 1\n\t- 2\n"}) {
    expect_message([&] { load(folder, text); }, "a.yaml:3: the line is indented by a tab");
  }
  // Within brackets, and behind the indentation, a tab is a space.
  EXPECT_EQ(load(folder, "a: [1,\n\t2]\nb:\t3\n").at("a").numbers(2)[1], 2);
}

TEST(YamlField, TextsInUtf8Only) {
  const TemporaryFolder folder;
  EXPECT_EQ(load(folder, "material: Gr\u00F6\u00DFe\n").at("material").text(), "Gr\u00F6\u00DFe");
  expect_message([&] { load(folder, "a: 1\nmaterial: Gr\xF6\n"); },
                 "a.yaml:2: has a letter that is not encoded in UTF-8");
}

TEST(YamlField, DecimalCommas) {
  const TemporaryFolder folder;
  const YamlField top = load(folder, "a: 1,4\nb: [30,5, -60, 80]\nc: {eta: 1,4}\nd: -0,5e-3\n");
  const std::string told = "write decimals with a point, not with a comma";
  expect_message([&] { top.at("a").number(); },
                 "a.yaml:1: a: expected a number; " + told + ", got 1,4");
  expect_message([&] { top.at("b").vector3(); },
                 "a.yaml:2: b: expected a list of 3 numbers; " + told);
  expect_message([&] { top.at("c").only({"eta"}); }, "a.yaml:3: c.4: unknown key; " + told);
  expect_message([&] { top.at("d").number(); }, told);
}

// What the system refuses to look up is a file that can't be read, no error of another kind.
TEST(YamlField, NamesThatTheSystemRefuses) {
  const TemporaryFolder folder;
  expect_message([&] { YamlField::load(folder / std::string(5000, 'a')); }, "no such file");
  std::filesystem::create_symlink("loop.yaml", std::filesystem::path(folder / "loop.yaml"));
  expect_message([&] { YamlField::load(folder / "loop.yaml"); }, "no such file");
  expect_message([&] { YamlField::load(folder / "."); }, "is a folder");
}

}  // namespace
}  // namespace scattermeter::apps
