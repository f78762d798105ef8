// Steps of a radiance calibration, in order.
#pragma once

#include <cstdint>
#include <vector>

#include "calib/radiance/calibrate_radiance.h"
#include "calib/radiance/frame_blocks.h"
#include "calib/radiance/response_fit.h"
#include "core/camera/cfa_pattern.h"

namespace scattermeter::calib {

// Results that the steps pass on to later ones.
struct RadianceSteps {
  const RadianceCalibrationInput& input;
  const RadianceFrames& open;
  capture::RadianceCalibration& calibration;
  // From the flats, set by find_response_and_noise().
  std::vector<Block> blocks = {};
  struct Light {
    double per_s = 0;  // light of a block in counts per stated second; 0: unknown
    double relative_variance = 0;
    double samples = 0;
    Eigen::VectorXd shared = {};  // FlatLight::shared, of curve and exposure times
  };
  std::vector<Light> light = {};             // of each block
  std::vector<double> settings_s = {};       // stated times, in the order of response_covariance
  Eigen::MatrixXd response_covariance = {};  // ResponseFit::joint_covariance
  double shot_std = 0;                       // ResponseFit::shot_std
  CfaPattern cfa = {};                       // of the flats
};

// Opens a shot and checks that it has an exposure time and the size, ISO and aperture of the first
// one.
capture::RawFrame open_radiance_shot(RadianceSteps& steps, const RadianceShot& shot);

// For each sample: 1 clipped, 2 defect, otherwise 0.
std::vector<std::uint8_t> marks_of(const capture::RawFrame& frame,
                                   const capture::RadianceCorrection& correction);

// Black at an exposure time.
std::array<double, 4> black_at(const capture::RadianceCorrection& correction, double exposure_s);

// Each step fills its part of steps.calibration and throws InputError as documented for
// calibrate_radiance().
void find_dark(RadianceSteps& steps);
void find_response_and_noise(RadianceSteps& steps);
void find_glare(RadianceSteps& steps);
void find_vignetting(RadianceSteps& steps);
void find_scale(RadianceSteps& steps);

}  // namespace scattermeter::calib
