#include "apps/instrument/weight_folder.h"

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/fixtures/temporary_folder.h"

namespace scattermeter::apps {
namespace {

namespace fs = std::filesystem;

WeightMatrix single_precision(int rows, int columns) {
  return Eigen::MatrixXf::Random(rows, columns).cast<double>();
}

std::string file_of(const TemporaryFolder& folder, const std::string& name) {
  return folder / ("deep/" + name + ".weights");
}

TEST(WeightFolder, FindsWhatAnotherKept) {
  const TemporaryFolder folder;
  const WeightMatrix kept = single_precision(5, 7);
  WeightFolder one(folder / "deep"), other(folder / "deep");
  const std::string name = one.name({1.0, 2.0});
  EXPECT_EQ(name, other.name({1.0, 2.0}));
  EXPECT_NE(name, one.name({1.0, -2.0}));
  EXPECT_FALSE(one.find(name));
  one.keep(name, kept);
  EXPECT_FALSE(fs::exists(folder / "deep"));
  EXPECT_EQ(one.write(), "");
  const auto found = other.find(name);
  ASSERT_TRUE(found);
  EXPECT_EQ(*found, kept);
  EXPECT_FALSE(other.find(one.name({1.0, -2.0})));
}

TEST(WeightFolder, DoesNotBelieveADamagedFile) {
  const TemporaryFolder folder;
  WeightFolder weights(folder / "deep");
  weights.keep("a", single_precision(5, 7));
  weights.write();
  const std::string path = file_of(folder, "a");
  fs::resize_file(path, fs::file_size(path) - 4);
  EXPECT_FALSE(weights.find("a"));
}

// Room for two and a half: of three, that which was used last stays.
TEST(WeightFolder, RemovesWhatWasNotUsedForLongest) {
  const TemporaryFolder folder;
  const WeightMatrix w = single_precision(100, 100);
  WeightFolder weights(folder / "deep", 100000);
  const auto age = [&](const std::string& name, int hours) {
    fs::last_write_time(file_of(folder, name),
                        fs::file_time_type::clock::now() - std::chrono::hours(hours));
  };
  weights.keep("a", w);
  weights.write();
  age("a", 2);
  weights.keep("b", w);
  weights.write();
  age("b", 1);
  EXPECT_TRUE(weights.find("a"));
  weights.keep("c", w);
  weights.write();
  EXPECT_TRUE(weights.find("a"));
  EXPECT_FALSE(weights.find("b"));
  EXPECT_TRUE(weights.find("c"));
}

TEST(WeightFolder, SaysWhyItCannotKeep) {
  WeightFolder weights("/proc/none");
  weights.keep("a", single_precision(1, 1));
  EXPECT_NE(weights.write(), "");
  EXPECT_EQ(weights.write(), "");
}

}  // namespace
}  // namespace scattermeter::apps
