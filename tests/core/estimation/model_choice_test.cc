#include "core/estimation/model_choice.h"

#include <cmath>

#include <gtest/gtest.h>

namespace scattermeter {
namespace {

// With an image of 1000 rows of this deviation.
ChannelResult good(double relative_std = 0.01) {
  ChannelResult result;
  result.image_in_std = std::sqrt(1000.0) / relative_std;
  result.estimate.converged = true;
  result.estimate.misfit_p_value = 0.3;
  return result;
}

TEST(ModelChoice, KeepsADipoleThatHolds) {
  EXPECT_EQ(why_transport(good()), "");
  ChannelResult slight = good();
  slight.estimate.misfit_p_value = 1e-12;
  slight.estimate.misfit_relative = 3e-4;
  EXPECT_EQ(why_transport(slight), "");
}

// What contradicts the rig although the dipole explains the image is not the dipole.
TEST(ModelChoice, KeepsARefusedDipoleThatExplainsTheImage) {
  ChannelResult contradicted = good();
  contradicted.estimate.reasons = {"the shots contradict the lens"};
  EXPECT_EQ(why_transport(contradicted), "");
  contradicted.estimate.converged = false;
  EXPECT_EQ(why_transport(contradicted), "the dipole is refused: the shots contradict the lens");
  contradicted.estimate.converged = true;
  contradicted.estimate.misfit_p_value = 1e-12;
  contradicted.estimate.misfit_relative = 0.04;
  EXPECT_EQ(why_transport(contradicted), "the dipole is refused: the shots contradict the lens");
}

TEST(ModelChoice, SaysWhyNot) {
  ChannelResult refused = good(0.2);
  refused.estimate.reasons = {"too dark"};
  EXPECT_EQ(why_transport(refused), "the dipole is refused: too dark");
  ChannelResult off = good();
  off.estimate.misfit_p_value = 1e-12;
  off.estimate.misfit_relative = 0.04;
  EXPECT_EQ(why_transport(off), "the dipole misses 4 % of the image");
  ChannelResult torn = good();
  torn.agreement = {40.0, 6, 1e-5};
  EXPECT_EQ(why_transport(torn), "the shots do not agree under the dipole");
  EXPECT_EQ(why_transport(good(0.2)),
            "noise hides what the dipole may miss, up to 5.1 % of the image");
}

}  // namespace
}  // namespace scattermeter
