// Check of an LED's position and light against the rig.
#pragma once

#include <array>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "calib/led/led_calibration_input.h"
#include "calib/led/led_shots.h"
#include "calib/led/plane_map.h"

namespace scattermeter::calib {

struct LedCheck {
  std::string light;
  // Residuals with the LED of the rig, with its position and axis taken as exact.
  double highlight_rms_px = 0, highlight_worst_px = 0;    // NaN without highlights
  double plane_rms_percent = 0, plane_worst_percent = 0;  // without the power change; or NaN
  // Fitted ambient light on the planes in percent of the LED's light, for the shot and channel
  // where it is largest, with its standard deviation. 0 if the shots show none or it was
  // subtracted; NaN without planes. The residuals above and the maps exclude it.
  double ambient_percent = 0, ambient_std_percent = 0;
  std::string ambient_file;
  // Median of measured over predicted radiance minus one, for each channel; NaN without planes. It
  // is the change of the product of power and responsivity: in a rig without a responsivity only
  // comparisons between lights have a meaning.
  Eigen::Array3d power_change_percent;
  // The shading of each plane shot, after subtracting the median of each channel.
  std::vector<LedPlaneMap> maps;
  std::vector<std::string> highlight_names;
  std::vector<Eigen::Vector2d> highlights_px;           // measured
  std::vector<Eigen::Vector2d> highlight_residuals_px;  // predicted - measured
  // Position of the LED from the shots minus that of the rig, and its covariance, which includes
  // that of the position in the rig. `problem` is not empty if the shots do not determine the
  // position.
  std::string problem;
  Eigen::Vector3d displacement_mm;
  Eigen::Matrix3d displacement_covariance_mm2;
  double displacement_length_mm = 0;
  double displacement_std_mm = 0;  // along it
  // The displacement in standard deviations, in three dimensions: sqrt(d' C^-1 d).
  double displacement_stds = 0;
  // Exponent that `calibrate led` finds from these shots minus that of the rig, and the angle
  // between the axes.
  double exponent_change = 0;
  double axis_change_rad = 0;
  // "led1 is 2.10 +- 0.12 mm from its position in the rig"
  std::string text;
  std::vector<std::string> notes;  // spheres without a highlight, clipped planes
};

// Measures the calibration shots of a light again and compares them with the rig. Throws InputError
// as read_led_shots() does.
LedCheck check_led(const LedCalibrationInput& input, const std::string& light,
                   const LedFrames& frames);

}  // namespace scattermeter::calib
