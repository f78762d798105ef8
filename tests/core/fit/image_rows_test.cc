#include "core/fit/image_rows.h"

#include <cstddef>
#include <stdexcept>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace scattermeter {
namespace {

DenseSystem small() {
  DenseSystem s{WeightMatrix(5, 2), Eigen::VectorXd(5), Eigen::VectorXd(5)};
  s.weights << 1, 2, 3, 4, 5, 6, 7, 8, 9, 10;
  s.l << 1, 2, 3, 4, 5;
  s.std_l << 10, 20, 30, 40, 50;
  s.shot_rows = {2, 0, 3};
  s.nuisances = {{"first", 0.1, true}, {"both", 0.2, true}, {"last", 0.3, false}};
  s.nuisance_columns.resize(5, 3);
  s.nuisance_columns << 1, 2, 0, 0, 3, 0, 0, 4, 5, 0, 6, 0, 0, 7, 8;
  return s;
}

TEST(ImageRows, StackedAgainTheyAreTheSystem) {
  const DenseSystem s = small();
  const SystemRows rows(s);
  EXPECT_EQ(rows.shots(), 3U);
  const DenseSystem again = stacked(rows);
  EXPECT_EQ(again.weights, s.weights);
  EXPECT_EQ(again.l, s.l);
  EXPECT_EQ(again.std_l, s.std_l);
  EXPECT_EQ(again.shot_rows, s.shot_rows);
  EXPECT_EQ(again.nuisance_columns, s.nuisance_columns);
  ASSERT_EQ(again.nuisances.size(), 3U);
  EXPECT_EQ(again.nuisances[2].group, "last");
  EXPECT_EQ(rows.shot(2).nuisances, (std::vector<Eigen::Index>{1, 2}));
}

// The count goes on from shot to shot.
TEST(ImageRows, EveryOtherRow) {
  const DenseSystem s = small();
  DenseSystem t = s;
  t.shot_rows = {1, 1, 3};
  for (const DenseSystem& of : {s, t}) {
    const DenseSystem some = stacked(SystemRows(of), 2);
    EXPECT_EQ(some.l, Eigen::Vector3d(1, 3, 5));
    EXPECT_EQ(some.nuisance_columns.col(1), Eigen::Vector3d(2, 4, 7));
  }
  EXPECT_EQ(stacked(SystemRows(t), 2).shot_rows, (std::vector<Eigen::Index>{1, 0, 2}));
  EXPECT_THROW(stacked(SystemRows(s), 0), std::invalid_argument);
}

// A system that does not say where its shots end is one.
TEST(ImageRows, OneShot) {
  DenseSystem s = small();
  s.shot_rows.clear();
  const SystemRows rows(s);
  EXPECT_EQ(rows.shots(), 1U);
  EXPECT_EQ(rows.shot(0).system.get(), &s);
  EXPECT_EQ(rows.shot(0).nuisances, (std::vector<Eigen::Index>{0, 1, 2}));
}

class CountedRows final : public ImageRows {
 public:
  explicit CountedRows(const DenseSystem& system) : rows_(system), calls(system.shot_rows.size()) {}
  std::size_t shots() const override { return rows_.shots(); }
  const std::vector<Nuisance>& nuisances() const override { return rows_.nuisances(); }
  ShotSystem shot(std::size_t shot) const override {
    ++calls[shot];
    return rows_.shot(shot);
  }

 private:
  SystemRows rows_;

 public:
  mutable std::vector<int> calls;
};

// Two rows of two weights, two nuisances, value and deviation take 96 bytes; three rows 144 (the
// shot of no rows none).
TEST(ImageRows, AreKeptWhereTheyFit) {
  const DenseSystem s = small();
  const CountedRows counted(s);
  for (const auto& [most_bytes, calls] :
       {std::pair{std::size_t{240}, std::vector{1, 1, 1}}, {239, {1, 1, 3}}, {95, {3, 1, 3}}}) {
    counted.calls.assign(3, 0);
    const KeptRows kept(counted, most_bytes);
    EXPECT_EQ(kept.shots(), 3U);
    EXPECT_EQ(kept.nuisances().size(), 3U);
    for (int i = 0; i < 3; ++i) {
      for (std::size_t shot = 0; shot < 3; ++shot) {
        const ShotSystem own = kept.shot(shot);
        EXPECT_EQ(own.nuisances, counted.shot(shot).nuisances);
        --counted.calls[shot];
        EXPECT_EQ(own.system->l, SystemRows(s).shot(shot).system->l);
      }
    }
    EXPECT_EQ(counted.calls, calls) << most_bytes;
  }
}

}  // namespace
}  // namespace scattermeter
