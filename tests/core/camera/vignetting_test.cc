#include "core/camera/vignetting.h"

#include <array>

#include <gtest/gtest.h>

namespace scattermeter {
namespace {

TEST(Vignetting, IsOneAtTheCentreAndTheSumOfItsTermsInTheCorner) {
  Vignetting v = vignetting_of_frame(301, 201);
  EXPECT_TRUE(v.is_identity());
  EXPECT_EQ(v.share(17, 3, 1), 1.0);
  v.radial[1] = {-0.3, 0.05, -0.02};
  EXPECT_FALSE(v.is_identity());
  EXPECT_EQ(v.share(150, 100, 1), 1.0);
  EXPECT_EQ(v.share(0, 0, 0), 1.0);
  // The corner sample lies half a pixel inside the frame's corner.
  const double s = (150.0 * 150.0 + 100.0 * 100.0) / (v.half_diagonal_px * v.half_diagonal_px);
  EXPECT_NEAR(v.share(0, 0, 1), 1.0 - 0.3 * s + 0.05 * s * s - 0.02 * s * s * s, 1e-14);
}

TEST(Vignetting, TermsAreWhatItsFactorsMultiply) {
  Vignetting v = vignetting_of_frame(300, 200);
  v.radial[2] = {-0.3, 0.05};
  v.map[2] = {0.01, -0.02, 0.03, 0.04};
  std::array<double, 6> t{};
  for (const auto& [x, y] : {std::pair{12.0, 150.0}, std::pair{280.0, 9.0}}) {
    Vignetting::terms((x - v.center_px.x()) / v.half_diagonal_px,
                      (y - v.center_px.y()) / v.half_diagonal_px, 2, 4, t.data());
    const double sum =
        -0.3 * t[0] + 0.05 * t[1] + 0.01 * t[2] - 0.02 * t[3] + 0.03 * t[4] + 0.04 * t[5];
    EXPECT_NEAR(v.share(x, y, 2), 1.0 + sum, 1e-14);
  }
}

}  // namespace
}  // namespace scattermeter
