#include "core/sums/series_bounds.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/fixtures/core/pole_terms.h"

namespace scattermeter {
namespace {

using test_support::derivative_along;

// Neither in any direction nor within a cone about the pole's normal plane.
TEST(SeriesBounds, NoDirectionHasALargerTerm) {
  for (int c = 0; c <= 2; ++c) {
    for (int n = 0; n <= 12; ++n) {
      for (const double y : {0.0, 0.03, 0.3, 1.0, 3.0, 10.0, 30.0}) {
        const double bound = largest_term(c, n, y, 1.0);
        EXPECT_NEAR(derivative_along(c, n, y, 1.0), bound, 1e-9 * bound);
        double largest = 0.0;
        for (int i = 0; i <= 400; ++i) {
          const double cosine = i / 400.0;
          largest = std::max(largest, std::abs(derivative_along(c, n, y, cosine)));
          const double directed = largest_term(c, n, y, cosine);
          EXPECT_LE(largest, directed * (1.0 + 1e-9))
              << "c " << c << " n " << n << " y " << y << " cos " << cosine;
          EXPECT_LE(directed, bound * (1.0 + 1e-9));
        }
      }
    }
  }
  // It is worth the trouble: at 60 degrees a term of degree 9 is a tenth of the largest.
  EXPECT_LT(largest_term(1, 9, 0.1, 0.5), 0.1 * largest_term(1, 9, 0.1, 1.0));
}

// For kappa = 0: Gegenbauer polynomials at 1, C(n + 2 lambda - 1, n), times (2c - 1)!!.
TEST(SeriesBounds, GegenbauerWithoutAbsorption) {
  EXPECT_DOUBLE_EQ(largest_term(0, 9, 0.0, 1.0), 1.0);
  EXPECT_DOUBLE_EQ(largest_term(1, 9, 0.0, 1.0), 55.0);
  EXPECT_DOUBLE_EQ(largest_term(2, 9, 0.0, 1.0), 3.0 * 715.0);
}

// The tables are those terms, at the deep end of each cell of depths.
TEST(SeriesBounds, TablesHoldTheLargestTerms) {
  const SeriesBounds& tables = series_bounds();
  for (std::size_t i = 0; i < std::size(kDegrees); ++i) {
    for (const double y : {0.01, 0.2, 1.0, 7.0}) {
      const std::size_t depth = SeriesBounds::depth_cell(y);
      EXPECT_GE(SeriesBounds::largest_depth(depth), y);
      for (const double angle_rad : {0.02, 0.7, 1.4}) {
        const std::size_t angle = SeriesBounds::angle_cell(angle_rad);
        for (int c = 0; c < 3; ++c) {
          const double first = tables.first[i][static_cast<std::size_t>(c)][depth][angle];
          EXPECT_NEAR(first,
                      largest_term(c, kDegrees[i] + 1, SeriesBounds::largest_depth(depth),
                                   std::cos(angle_rad)),
                      1e-9 * first);
        }
        // All terms are at least the first, and add up to more at larger ratios.
        EXPECT_GE(tables.tail[i][depth][angle][0], 1.0F);
        EXPECT_GT(tables.tail[i][depth][angle][23], tables.tail[i][depth][angle][0]);
      }
    }
  }
}

}  // namespace
}  // namespace scattermeter
