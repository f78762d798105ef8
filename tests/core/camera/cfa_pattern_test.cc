#include "core/camera/cfa_pattern.h"

#include <stdexcept>

#include <gtest/gtest.h>

namespace scattermeter {
namespace {

TEST(CfaPattern, NamesGoThereAndBack) {
  for (const std::string name : {"RGGB", "GRBG", "GBRG", "BGGR"}) {
    EXPECT_EQ(cfa_pattern_name(cfa_pattern_from_name(name)), name);
  }
  for (const std::string name : {"", "rggb", "RGBG", "RGGBX", "RGGE"}) {
    EXPECT_THROW(cfa_pattern_from_name(name), std::invalid_argument) << name;
  }
}

TEST(CfaPattern, RepeatsEveryTwoSamples) {
  const CfaPattern pattern = cfa_pattern_from_name("GBRG");
  EXPECT_EQ(pattern.at(0, 0), Channel::kGreen);
  EXPECT_EQ(pattern.at(1, 0), Channel::kBlue);
  EXPECT_EQ(pattern.at(0, 1), Channel::kRed);
  EXPECT_EQ(pattern.at(1, 1), Channel::kGreen);
  EXPECT_EQ(pattern.at(7, 4), Channel::kBlue);
}

}  // namespace
}  // namespace scattermeter
