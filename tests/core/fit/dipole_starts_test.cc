#include "core/fit/dipole_starts.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "core/diffusion/dipole_curve.h"
#include "tests/fixtures/core/lit_plate.h"
#include "tests/fixtures/core/noisy_system.h"

namespace scattermeter {
namespace {

// For images without noise one of the starts is in reach: the mean free path to a factor of two.
TEST(DipoleStarts, AreNearEveryMaterial) {
  const test_support::LitPlate plate(1.0, {0, 15, -15, 15});
  const DistanceKnots knots = plate.knots();
  const WeightMatrix w = plate.weights(knots);
  for (double sigma_t : {0.1, 0.5, 2.0, 5.0}) {
    for (double q : {0.0, 1e-3, 0.05, 0.2, 0.6}) {
      const Eigen::VectorXd l = w * dipole_curve(knots, std::log(sigma_t), q, 1.3).r;
      const RecoveredReflectance recovered =
          recover_reflectance(test_support::noisy_system(w, l, 1e-3, 1));
      for (double scale_std : {0.0, 0.02, std::numeric_limits<double>::infinity()}) {
        const auto starts =
            dipole_starts(recovered.sqrt_information, recovered.whitened, knots, 1.3, {scale_std});
        ASSERT_FALSE(starts.empty());
        EXPECT_LE(starts.size(), 3U);
        bool near = false;
        for (std::size_t i = 0; i < starts.size(); ++i) {
          near = near || std::abs(starts[i].u - std::log(sigma_t)) < std::log(2.0);
          EXPECT_GE(starts[i].cost, starts[i > 0 ? i - 1 : 0].cost);
          EXPECT_TRUE(scale_std > 0.0 || starts[i].log_s == 0.0);
        }
        EXPECT_TRUE(near) << sigma_t << ' ' << q << ' ' << scale_std;
      }
    }
  }
}

}  // namespace
}  // namespace scattermeter
