#include "apps/instrument/atlas_folder.h"

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/fixtures/temporary_folder.h"

namespace scattermeter::apps {
namespace {

const std::vector<double> kNumbers{1.0, 2.0, 1.0 / 3.0};
const std::string kBody = AtlasFolder("").name(kNumbers);
const Eigen::Vector3d kCenter(1.0 / 3.0, -400.0, 1e-7);

WhiteSums sums(int levels) {
  WhiteSums out;
  out.levels = levels;
  out.sum = Eigen::MatrixXd::Random(5, 7);
  out.per_eta = Eigen::MatrixXf::Random(2, 7);
  out.batches = PackedBatches(2, 4, 7);
  out.batches.add({Eigen::MatrixXf::Random(4, 7), Eigen::MatrixXf::Random(4, 7)});
  return out;
}

void expect_equal(const std::optional<WhiteSums>& a, const WhiteSums& b) {
  ASSERT_TRUE(a);
  EXPECT_EQ(a->levels, b.levels);
  EXPECT_EQ(a->sum, b.sum);
  EXPECT_EQ(a->per_eta, b.per_eta);
  EXPECT_EQ(a->batches.steps, b.batches.steps);
  EXPECT_EQ(a->batches.step_of, b.batches.step_of);
}

TEST(AtlasFolder, FindsWhatAnotherKept) {
  const TemporaryFolder folder;
  const std::string path = folder / "deep/atlas";
  const WhiteSums kept = sums(3);
  AtlasFolder one(path);
  EXPECT_TRUE(one.centers_mm(kBody).empty());
  EXPECT_FALSE(one.find(kBody, kCenter, -4));
  one.keep(kBody, kCenter, -4, kept);
  EXPECT_EQ(one.problem(), "");
  AtlasFolder other(path);
  const std::vector<Eigen::Vector3d> centers = other.centers_mm(kBody);
  ASSERT_EQ(centers.size(), 1U);
  EXPECT_EQ(centers[0], kCenter);
  expect_equal(other.find(kBody, kCenter, -4), kept);
  EXPECT_FALSE(other.find(kBody, kCenter, -3));
  EXPECT_EQ(other.name(kNumbers), kBody);
  EXPECT_FALSE(other.find(other.name({1.0, 2.0, 0.3333}), kCenter, -4));
  EXPECT_TRUE(other.centers_mm(other.name({1.0, 2.0})).empty());
}

// Two programs that refine the same node: the one with more paths stays, in either order.
TEST(AtlasFolder, KeepsTheMostPaths) {
  const TemporaryFolder folder;
  AtlasFolder one(folder / ""), other(folder / "");
  const WhiteSums few = sums(2), many = sums(5);
  one.keep(kBody, kCenter, 0, few);
  other.keep(kBody, kCenter, 0, many);
  one.keep(kBody, kCenter, 0, sums(3));
  expect_equal(one.find(kBody, kCenter, 0), many);
}

// What is damaged is not there, and is written again.
TEST(AtlasFolder, DoesNotBelieveADamagedFile) {
  const TemporaryFolder folder;
  AtlasFolder atlas(folder / "");
  const WhiteSums kept = sums(2);
  atlas.keep(kBody, kCenter, 1, kept);
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder / "")) {
    if (entry.path().extension() == ".paths") {
      std::filesystem::resize_file(entry.path(), entry.file_size() / 2);
    }
  }
  EXPECT_FALSE(atlas.find(kBody, kCenter, 1));
  atlas.keep(kBody, kCenter, 1, kept);
  expect_equal(atlas.find(kBody, kCenter, 1), kept);
}

TEST(AtlasFolder, SaysWhyItKeepsNothing) {
  const TemporaryFolder folder;
  std::ofstream(folder / "file") << "not a folder";
  AtlasFolder atlas(folder / "file");
  atlas.keep(kBody, kCenter, 0, sums(1));
  EXPECT_NE(atlas.problem().find(folder / "file"), std::string::npos) << atlas.problem();
}

}  // namespace
}  // namespace scattermeter::apps
