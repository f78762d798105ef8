// Does an LED still stand and shine as the rig says?
#pragma once

#include <array>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "calib/led/led_calibration_input.h"
#include "calib/led/led_shots.h"

namespace scattermeter::calib {

// A plane's shading against the rig's prediction, cell by cell.
struct LedPlaneMap {
  std::string file;
  int columns = 0, rows = 0;
  // Measured over predicted less one, percent, mean of the channels, each without its own median
  // (power_change_percent); row by row, NaN where there is no cell. And its standard deviation, by
  // the noise of the samples.
  std::vector<double> percent, std_percent;
};

struct LedCheck {
  std::string light;
  // Of the rig's LED, its pose taken as exact.
  double highlight_rms_px = 0, highlight_worst_px = 0;    // NaN without highlights
  double plane_rms_percent = 0, plane_worst_percent = 0;  // without the power's; NaN without planes
  // Fitted light beside the LED on the planes, percent of its own: the brightest shot and channel,
  // with its deviation. 0 where the shots show none or it was subtracted; NaN without planes. The
  // figures above and the maps are without it.
  double ambient_percent = 0, ambient_std_percent = 0;
  std::string ambient_file;
  // Median of measured over predicted less one, per channel; NaN without planes. Of the product of
  // power and responsivity: in a rig without a responsivity only the lights among each other count.
  Eigen::Array3d power_change_percent;
  std::vector<LedPlaneMap> maps;
  std::vector<std::string> highlight_names;
  std::vector<Eigen::Vector2d> highlights_px;           // measured
  std::vector<Eigen::Vector2d> highlight_residuals_px;  // predicted - measured
  // Where the shots put the LED, less where the rig says; its covariance, that of what the rig
  // itself says of the place included. `problem` is not empty where the shots do not tell.
  std::string problem;
  Eigen::Vector3d displacement_mm;
  Eigen::Matrix3d displacement_covariance_mm2;
  double displacement_length_mm = 0;
  double displacement_std_mm = 0;  // along it
  // sqrt(d' C^-1 d): how many standard deviations that is, in three dimensions.
  double displacement_stds = 0;
  // What `calibrate led` would make of these shots: exponent less the rig's, axes apart.
  double exponent_change = 0;
  double axis_change_rad = 0;
  // "led1 stands 2.1 +- 0.1 mm from where the rig says"
  std::string text;
  std::vector<std::string> notes;  // spheres without a highlight, clipped planes
};

// Re-measures the calibration shots of a light and holds them against the rig. Throws InputError as
// read_led_shots() does.
LedCheck check_led(const LedCalibrationInput& input, const std::string& light,
                   const LedFrames& frames);

}  // namespace scattermeter::calib
