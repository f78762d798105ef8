#include "apps/instrument/weight_folder.h"

#include <gtest/gtest.h>

#include "tests/fixtures/temporary_folder.h"

namespace scattermeter::apps {
namespace {

TEST(WeightFolder, FindsWhatAnotherKept) {
  const TemporaryFolder folder;
  const WeightMatrix kept = Eigen::MatrixXf::Random(5, 7).cast<double>();
  WeightFolder one(folder / "deep"), other(folder / "deep");
  const std::string name = one.name({1.0, 2.0});
  EXPECT_EQ(name, other.name({1.0, 2.0}));
  EXPECT_NE(name, one.name({1.0, -2.0}));
  EXPECT_FALSE(one.find(name));
  one.keep(name, kept);
  EXPECT_EQ(one.write(), "");
  const auto found = other.find(name);
  ASSERT_TRUE(found);
  EXPECT_EQ(*found, kept);
  EXPECT_FALSE(other.find(one.name({1.0, -2.0})));
}

// The digest is right, but the content is not that of weights.
TEST(WeightFolder, FindsNoWeightsInOtherBytes) {
  const TemporaryFolder folder;
  KeptFolder files(folder / "deep", ".weights");
  files.keep("a", "some other content");
  ASSERT_EQ(files.write(), "");
  EXPECT_FALSE(WeightFolder(folder / "deep").find("a"));
}

}  // namespace
}  // namespace scattermeter::apps
