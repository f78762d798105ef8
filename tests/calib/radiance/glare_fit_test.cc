#include "calib/radiance/glare_fit.h"

#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

namespace scattermeter::calib {
namespace {

TEST(GlareFit, IsTheTrapsShareOfTheFrame) {
  const GlareFit fit = fit_glare({{10, 0.1, 1000}, {20, 0.1, 2000}}, 0.0);
  ASSERT_TRUE(fit.ok);
  EXPECT_NEAR(fit.share, 0.01, 1e-12);
  EXPECT_NEAR(fit.std, 0.1 / std::hypot(1000, 2000), 1e-9);
}

TEST(GlareFit, TrapsThatDifferWidenIt) {
  const GlareFit fit = fit_glare({{12, 0.1, 1000}, {8, 0.1, 1000}, {10, 0.1, 1000}}, 0.0);
  EXPECT_NEAR(fit.share, 0.01, 1e-12);
  EXPECT_NEAR(fit.std, 0.002, 1e-4);
  EXPECT_NEAR(fit.worst_counts, 2.0, 1e-12);
}

TEST(GlareFit, ModelWidensItAndNegativeSharesAreNone) {
  EXPECT_NEAR(fit_glare({{10, 0.001, 1000}}, 0.3).std, 0.003, 1e-6);
  const GlareFit none = fit_glare({{-0.05, 0.1, 1000}}, 0.0);
  EXPECT_TRUE(none.ok);
  EXPECT_EQ(none.share, 0.0);
  EXPECT_FALSE(fit_glare({}, 0.0).ok);
  EXPECT_FALSE(fit_glare({{1, 0.1, 0}}, 0.0).ok);
  EXPECT_THROW(fit_glare({{1, 0, 10}}, 0.0), std::invalid_argument);
}

}  // namespace
}  // namespace scattermeter::calib
