#include "calib/led/led_calibration_input.h"

#include <stdexcept>

#include <gtest/gtest.h>

namespace scattermeter::calib {
namespace {

TEST(LedCalibrationInput, FindsAnLedByItsName) {
  LedCalibrationInput input;
  for (const char* name : {"led1", "led2"}) {
    input.leds.emplace_back();
    input.leds.back().name = name;
  }
  EXPECT_EQ(&input.led("led2"), &input.leds[1]);
  EXPECT_THROW(input.led("led3"), std::out_of_range);
}

}  // namespace
}  // namespace scattermeter::calib
