#include "core/fit/residual.h"

#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

namespace scattermeter {
namespace {

TEST(Residual, ByHand) {
  const Eigen::Vector2d l(3.0, 4.0);
  const Eigen::Vector2d predicted(3.0, 3.5);
  const Residual r = residual(l, predicted, Eigen::Vector2d(0.1, 0.25));
  EXPECT_NEAR(r.chi2, 4.0, 1e-12);
  EXPECT_NEAR(r.rms_relative, 0.1, 1e-12);  // 0.5 / sqrt(2) over 5 / sqrt(2)
  EXPECT_NEAR(r.psnr_db, 20.0 * std::log10(4.0 / (0.5 / std::sqrt(2.0))), 1e-12);
}

TEST(Residual, RefusesDifferentLengths) {
  EXPECT_THROW(residual(Eigen::VectorXd(2), Eigen::VectorXd(3), Eigen::VectorXd(2)),
               std::invalid_argument);
  EXPECT_THROW(residual({}, {}, {}), std::invalid_argument);
}

}  // namespace
}  // namespace scattermeter
