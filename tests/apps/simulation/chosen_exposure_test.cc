#include "apps/simulation/chosen_exposure.h"

#include <gtest/gtest.h>

#include "core/base/input_error.h"

namespace scattermeter::apps {
namespace {

TEST(ChosenExposure, HasTwoDigits) {
  EXPECT_DOUBLE_EQ(rounded_exposure_s(0.0987), 0.098);
  EXPECT_DOUBLE_EQ(rounded_exposure_s(1234.0), 1200.0);
  EXPECT_DOUBLE_EQ(rounded_exposure_s(9.999), 9.9);
}

TEST(ChosenExposure, KeepsWhatHasTwoDigits) {
  for (const double s : {0.1, 0.3, 0.007, 2.5, 1.0 / 125.0, 30.0, 1e-4}) {
    EXPECT_DOUBLE_EQ(rounded_exposure_s(s), s);
  }
}

TEST(ChosenExposure, IsOneThatARawFileHolds) {
  EXPECT_DOUBLE_EQ(full_exposure_s("rig.yaml", 0.0987), 0.098);
  EXPECT_THROW(full_exposure_s("rig.yaml", 4e-13), InputError);
  EXPECT_THROW(full_exposure_s("rig.yaml", 2e12), InputError);
}

}  // namespace
}  // namespace scattermeter::apps
