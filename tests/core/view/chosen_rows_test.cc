#include "core/view/chosen_rows.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include <gtest/gtest.h>

namespace scattermeter {
namespace {

// A plate of 32 x 32 patches of 1 mm.
std::vector<Eigen::Vector3d> patches_of_plate() {
  std::vector<Eigen::Vector3d> out;
  for (int i = 0; i < 32; ++i) {
    for (int j = 0; j < 32; ++j) out.emplace_back(i + 0.5, j + 0.5, 0.0);
  }
  return out;
}

TEST(ChosenRows, AreSpreadEvenlyOverTheSurface) {
  const std::vector<Eigen::Vector3d> all = patches_of_plate();
  const RowChoice choice = spread_rows(all, 6);
  ASSERT_EQ(choice.rows.size(), 64U);
  EXPECT_TRUE(std::is_sorted(choice.rows.begin(), choice.rows.end()));
  // One in each square of 4 x 4 patches, beside its centre; the others are stood for by it.
  std::set<std::pair<int, int>> squares;
  for (const std::size_t row : choice.rows) {
    const Eigen::Vector3d& p = all[row];
    squares.insert({static_cast<int>(p.x()) / 4, static_cast<int>(p.y()) / 4});
  }
  EXPECT_EQ(squares.size(), 64U);
  for (std::size_t j = 0; j < all.size(); ++j) {
    const std::size_t row = choice.rows.at(static_cast<std::size_t>(choice.stands_for_it[j]));
    EXPECT_LT((all[row] - all[j]).cwiseAbs().maxCoeff(), 2.6);
  }
}

TEST(ChosenRows, AreAllWhereThereAreFew) {
  const RowChoice choice = spread_rows(patches_of_plate(), 12);
  EXPECT_EQ(choice.rows.size(), 1024U);
  for (std::size_t j = 0; j < choice.rows.size(); ++j) {
    EXPECT_EQ(choice.rows[j], j);
    EXPECT_EQ(choice.stands_for_it[j], static_cast<std::int32_t>(j));
  }
  EXPECT_TRUE(spread_rows({}, 3).rows.empty());
  EXPECT_THROW(spread_rows(patches_of_plate(), -1), std::invalid_argument);
}

TEST(ChosenRows, KeepWhatWasObserved) {
  Observation all;
  for (ChannelObservation& o : all.channel) {
    for (int j = 0; j < 6; ++j) {
      o.l.push_back(10.0 + j);
      o.variance.push_back(0.1 * j);
      o.variance_per_l.push_back(0.01 * j);
      o.l_per_count.push_back(1.0 + j);
      o.state.push_back(j == 4 ? RowState::kClipped : RowState::kUsed);
    }
    o.rows_used = 5;
    o.rows_clipped = 1;
    o.samples = 60;
    o.exposures = {{{0, 1, 2, 3, 4, 5}, 7}};
  }
  const ChannelObservation some = with_rows(all, {{1, 4}, {0, 0, 0, 1, 1, 1}}).channel[2];
  EXPECT_EQ(some.l, (std::vector<double>{11, 14}));
  EXPECT_EQ(some.variance, (std::vector<double>{0.1, 0.4}));
  EXPECT_EQ(some.l_per_count, (std::vector<double>{2, 5}));
  EXPECT_EQ(some.rows_used, 1U);
  EXPECT_EQ(some.rows_clipped, 1U);
  EXPECT_EQ(some.samples, 60U);
  EXPECT_EQ(some.exposures.at(0).of_row, (std::vector<double>{1, 4}));
}

TEST(ChosenRows, StandForTheirNeighboursInPictures) {
  SampleMap map;
  map.width = 4;
  map.height = 1;
  map.row_of_sample = {-1, 0, 1, 2};
  map.patch_of_row = {7, 8, 9};
  map.samples.resize(3);
  map.of_quarters.resize(3);
  map.coverage = {0.8, 0.9, 1.0};
  map.guarded_of_row = {3, 0, 0};
  const SampleMap some = with_rows(map, {{1, 2}, {0, 0, 1}});
  EXPECT_EQ(some.row_of_sample, (std::vector<std::int32_t>{-1, 0, 0, 1}));
  EXPECT_EQ(some.patch_of_row, (std::vector<int>{8, 9}));
  EXPECT_EQ(some.coverage, (std::vector<double>{0.9, 1.0}));
}

}  // namespace
}  // namespace scattermeter
