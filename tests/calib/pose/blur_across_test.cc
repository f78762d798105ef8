#include "calib/pose/blur_across.h"

#include <cmath>

#include <gtest/gtest.h>

namespace scattermeter::calib {
namespace {

std::vector<BlurAcross> blurs_of(const Eigen::Matrix2d& px2, double from_rad, double to_rad) {
  std::vector<BlurAcross> out;
  constexpr int kPieces = 24;
  for (int i = 0; i < kPieces; ++i) {
    const double angle = from_rad + (to_rad - from_rad) * i / kPieces;
    const Eigen::Vector2d outward(std::cos(angle), std::sin(angle));
    out.push_back({outward, outward.dot(px2 * outward)});
  }
  return out;
}

TEST(BlurAcross, IsThatOfThePointSpread) {
  const Eigen::Matrix2d px2{{2.0, 0.5}, {0.5, 1.0}};
  std::vector<BlurAcross> blurs = blurs_of(px2, 0.0, M_PI);
  EXPECT_LT((point_spread_px2(blurs).value() - px2).norm(), 0.1);
  // A few that are far off, as beside another edge, do not count.
  for (std::size_t i = 0; i < 4; ++i) blurs[6 * i].px2 = 30.0;
  EXPECT_LT((point_spread_px2(blurs).value() - px2).norm(), 0.15);
}

TEST(BlurAcross, EdgesOfOneDirectionAreTakenForAll) {
  const Eigen::Matrix2d px2{{4.0, 0.0}, {0.0, 4.0}};
  EXPECT_LT((point_spread_px2(blurs_of(px2, 0.0, 0.01)).value() - px2).norm(), 0.1);
}

TEST(BlurAcross, FewEdgesTellNothing) {
  std::vector<BlurAcross> blurs = blurs_of(Eigen::Matrix2d::Identity(), 0.0, M_PI);
  blurs.resize(8);
  EXPECT_TRUE(point_spread_px2(blurs));
  blurs.pop_back();
  EXPECT_FALSE(point_spread_px2(blurs));
}

}  // namespace
}  // namespace scattermeter::calib
