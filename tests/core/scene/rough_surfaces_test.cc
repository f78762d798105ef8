#include "core/scene/rough_surfaces.h"

#include <gtest/gtest.h>

namespace scattermeter {
namespace {

// A row counts as glossy by its gloss over its irradiance, in any unit.
TEST(RoughSurfaces, LeaveOutWhatMirrorsALight) {
  const RowGloss gloss{Eigen::Vector3d(0.02, 0.03, 0.0), Eigen::Vector3d(1.0, 1.0, 0.0)};
  EXPECT_FALSE(is_glossy(gloss, 0));
  EXPECT_TRUE(is_glossy(gloss, 1));
  EXPECT_FALSE(is_glossy(gloss, 2));
}

TEST(RoughSurfaces, ChangeNothingOfNoRows) {
  const RoughSurfaces none(Scene{}, 0, {});
  EXPECT_EQ(none.gloss().size(), 0);
  EXPECT_EQ(none.change(Eigen::VectorXd(), Eigen::VectorXd()).size(), 0);
}

}  // namespace
}  // namespace scattermeter
