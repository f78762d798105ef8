#include "core/fit/shot_parts.h"

#include <stdexcept>

#include <gtest/gtest.h>

namespace scattermeter {
namespace {

// Two shots of a 32 x 16 grid each, brighter to the right.
struct PartShots {
  std::vector<Eigen::Index> rows = {512, 512};
  std::vector<Eigen::Vector3d> center;
  std::vector<double> area;
  Eigen::VectorXd l{1024};
  PartShots() {
    for (int shot = 0; shot < 2; ++shot) {
      for (int i = 0; i < 32; ++i) {
        for (int j = 0; j < 16; ++j) {
          l[static_cast<Eigen::Index>(center.size())] = 1.0 + 0.1 * i;
          center.emplace_back(i, j, 5.0 * shot);
          area.push_back(0.1 + 0.01 * j);
        }
      }
    }
  }
};

TEST(ShotParts, RelativeLight) {
  const PartShots s;
  const ShotParts parts(s.rows, s.center, s.area, s.l, {2, 96.0, 2, 10});
  EXPECT_EQ(parts.n_parts(), 8);
  EXPECT_EQ(parts.n_cells(), 32);
  // The observed light is one in every cell and part, and differs nowhere from its part's.
  EXPECT_LT((parts.cells() * s.l - Eigen::VectorXd::Ones(32)).norm(), 1e-12);
  EXPECT_LT((parts.parts() * Eigen::VectorXd::Ones(32) - Eigen::VectorXd::Ones(8)).norm(), 1e-12);
  EXPECT_LT((parts.about_parts() * Eigen::VectorXd::Ones(32)).norm(), 1e-12);
  // A part is off by what its rows' light is off by, however its cells share it.
  Eigen::VectorXd more = Eigen::VectorXd::Zero(1024);
  double own = 0.0, of_part = 0.0;
  for (Eigen::Index j = 0; j < 1024; ++j) {
    if (parts.part_of_row(j) != 5) continue;
    const double light = s.area[static_cast<std::size_t>(j)] * s.l[j];
    of_part += light;
    if (parts.cell_of_row(j) % 2 == 0) continue;
    more[j] = 0.03 * s.l[j];
    own += 0.03 * light;
  }
  const Eigen::VectorXd off = parts.parts() * (parts.cells() * more);
  EXPECT_NEAR(off[5], own / of_part, 1e-12);
  EXPECT_NEAR(off.cwiseAbs().sum(), own / of_part, 1e-12);
  const Eigen::VectorXd about = parts.about_parts() * (parts.cells() * more);
  EXPECT_GT(about.norm(), 0.01);
  EXPECT_LT((parts.parts() * about).norm(), 1e-12);
}

// Levelled light has the detail of one image and the sums, in the parts, of another.
TEST(ShotParts, Levelled) {
  const PartShots s;
  const ShotParts parts(s.rows, s.center, s.area, s.l, {2, 96.0, 2, 10});
  const Eigen::VectorXd rows = Eigen::VectorXd::LinSpaced(1024, -1.0, 3.0);
  const Eigen::VectorXd light = s.l.cwiseSqrt();
  const Eigen::VectorXd levelled = parts.levelled(light, rows);
  const ShotParts::Sums sums = parts.parts() * parts.cells();
  EXPECT_LT((sums * (levelled - rows)).norm(), 1e-12);
  const Eigen::VectorXd ratio = levelled.cwiseQuotient(light);
  for (Eigen::Index j = 1; j < 1024; ++j) {
    if (parts.part_of_row(j) != parts.part_of_row(0)) continue;
    EXPECT_NEAR(ratio[j], ratio[0], 1e-12);
  }
}

// No part and no cell holds rows of two shots; many shots have fewer parts each.
TEST(ShotParts, KeepShotsApart) {
  const PartShots s;
  const ShotParts parts(s.rows, s.center, s.area, s.l);
  for (Eigen::Index j = 0; j < 1024; ++j) {
    EXPECT_EQ(parts.part_of_row(j) < parts.n_parts() / 2, j < 512);
    EXPECT_EQ(parts.cell_of_row(j) < parts.n_cells() / 2, j < 512);
  }
  const ShotParts few(s.rows, s.center, s.area, s.l, {4, 4.0, 2, 12});
  EXPECT_EQ(few.n_parts(), 4);
  EXPECT_THROW(ShotParts({512}, s.center, s.area, s.l), std::invalid_argument);
}

}  // namespace
}  // namespace scattermeter
