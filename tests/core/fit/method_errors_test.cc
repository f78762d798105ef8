#include "core/fit/method_errors.h"

#include <gtest/gtest.h>

#include "tests/fixtures/core/plate_system.h"

namespace scattermeter {
namespace {

using test_support::plate;

TEST(MethodErrors, RowsErrFromTheirPatchAgainstTheMeanFreePath) {
  EXPECT_DOUBLE_EQ(row_method_error(0.4, 0.4), 1e-4);
  EXPECT_DOUBLE_EQ(row_method_error(0.4, 0.2), 4e-4);
  EXPECT_DOUBLE_EQ(row_method_error(0.4, 4.0), 3e-5);
}

// Held, one of every octave and every shot, which add up to the image; wider where patches are
// coarse.
TEST(MethodErrors, SharesOfTheImage) {
  const auto& p = plate();
  DenseSystem system{p.w, Eigen::VectorXd::Ones(p.w.rows()), Eigen::VectorXd::Ones(p.w.rows())};
  const Eigen::VectorXd r = Eigen::VectorXd::LinSpaced(p.w.cols(), 2.0, 1.0);
  const Eigen::Index half = system.l.size() / 2;
  system.shot_rows = {half, system.l.size() - half};
  add_method_errors(p.knots, r, 1.0, {2.0, 0.0, 1.3}, system);
  const Eigen::Index n = system.nuisance_columns.cols();
  ASSERT_EQ(static_cast<Eigen::Index>(system.nuisances.size()), n);
  const Eigen::VectorXd image = p.w * r;
  const Eigen::VectorXd octaves = system.nuisance_columns.leftCols(n - 2).rowwise().sum();
  EXPECT_LT((octaves - image).norm(), 1e-12 * image.norm());
  const Eigen::VectorXd shots = system.nuisance_columns.rightCols(2).rowwise().sum();
  EXPECT_LT((shots - image).norm(), 1e-12 * image.norm());
  EXPECT_EQ(system.nuisance_columns.col(n - 1).head(half).norm(), 0.0);
  for (const Nuisance& nuisance : system.nuisances) {
    EXPECT_FALSE(nuisance.fitted);
    EXPECT_DOUBLE_EQ(nuisance.std, 6e-4);
  }
}

}  // namespace
}  // namespace scattermeter
