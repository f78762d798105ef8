#include "apps/results/material_library.h"

#include <cmath>
#include <filesystem>

#include <gtest/gtest.h>

#include "core/base/input_error.h"
#include "tests/fixtures/apps/made_result.h"
#include "tests/fixtures/temporary_folder.h"

namespace scattermeter::apps {
namespace {

class MaterialLibraryTest : public ::testing::Test {
 protected:
  std::string written(const std::string& name, const MadeMaterials& materials) {
    std::filesystem::create_directories(folder_ / "a");
    write_file(folder_ / name, made_result(materials).dump());
    return folder_ / name;
  }
  TemporaryFolder folder_;
};

TEST_F(MaterialLibraryTest, TheLikestComesFirst) {
  const ReadResult result =
      read_result(written("x.json", {{"stone", {{2.3, 2.5, 3.1}, {0.002, 0.004, 0.007}}}}));
  const std::vector<LibraryMatch> found = matches(result, "stone", {published_library()});
  ASSERT_EQ(found.size(), 12U);
  EXPECT_EQ(found.front().comparison.second, "marble");
  EXPECT_EQ(found.front().of, "Jensen et al. 2001");
  EXPECT_FALSE(found.front().comparison.is_different());
  EXPECT_TRUE(found.back().comparison.is_different());
  for (std::size_t i = 1; i < found.size(); ++i) {
    EXPECT_LE(found[i - 1].distance, found[i].distance);
  }
}

// rms over the channels of ln 2 in sigma_s' and half of ln 4 in sigma_a.
TEST_F(MaterialLibraryTest, DistanceIsThatOfWhatIsSeen) {
  const ReadResult one =
      read_result(written("x.json", {{"a", {{1, 1, 1}, {0.001, 0.001, 0.001}}}}));
  const ReadResult two =
      read_result(written("y.json", {{"b", {{2, 2, 2}, {0.004, 0.004, 0.004}}}}));
  const std::vector<LibraryMatch> found = matches(one, "a", {two});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].distance, std::sqrt(2.0) * std::log(2.0), 1e-12);
}

TEST_F(MaterialLibraryTest, AFolderHoldsResultsAndOtherFiles) {
  const std::string own = written("x.json", {{"a", {{1, 1, 1}, {0.001, 0.001, 0.001}}}});
  EXPECT_THROW(results_in(folder_.path(), own), InputError);
  const std::string other = written("a/result.json", {{"b", {{1, 1, 1}, {0.001, 0.001, 0.001}}}});
  write_file(folder_ / "a/check.json", std::string("{}"));
  const ResultFolder found = results_in(folder_.path(), own);
  ASSERT_EQ(found.results.size(), 1U);
  EXPECT_EQ(found.results[0].path, other);
  EXPECT_EQ(found.left_out, std::vector<std::string>{folder_ / "a/check.json"});
  EXPECT_THROW(results_in(folder_ / "none", own), InputError);
}

}  // namespace
}  // namespace scattermeter::apps
