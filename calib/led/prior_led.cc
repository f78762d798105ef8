#include "calib/led/prior_led.h"

#include "core/base/tangents.h"

namespace scattermeter::calib {

LedUncertainty uncertainty_of(const PriorLed& prior) {
  if (prior.calibrated) return *prior.calibrated;
  LedVector std;
  std.head<3>().setConstant(prior.position_std_mm);
  std.segment<2>(kLedAxis).setConstant(prior.axis_std_rad);
  std[kLedExponent] = prior.exponent_std;
  std.segment<3>(kLedLogIntensity).setConstant(prior.power_relative_std);
  LedUncertainty out;
  out.tangents = tangents(prior.led.axis);
  out.covariance = std.cwiseAbs2().asDiagonal();
  return out;
}

}  // namespace scattermeter::calib
