// The steps of a radiance calibration, in their order.
#pragma once

#include <cstdint>
#include <vector>

#include "calib/radiance/calibrate_radiance.h"
#include "calib/radiance/frame_blocks.h"
#include "calib/radiance/response_fit.h"
#include "core/camera/cfa_pattern.h"

namespace scattermeter::calib {

// What one step leaves for the next.
struct RadianceSteps {
  const RadianceCalibrationInput& input;
  const RadianceFrames& open;
  capture::RadianceCalibration& calibration;
  // Of the flats, by find_response_and_noise().
  std::vector<Block> blocks = {};
  struct Light {
    double per_s = 0;  // light of a block, counts a stated second; 0: unknown
    double relative_variance = 0;
    double samples = 0;
    Eigen::VectorXd shared = {};  // FlatLight::shared: curve and exposure times
  };
  std::vector<Light> light = {};             // of each block
  std::vector<double> settings_s = {};       // stated times, as in the next
  Eigen::MatrixXd response_covariance = {};  // ResponseFit::joint_covariance
  double shot_std = 0;                       // ResponseFit::shot_std
  CfaPattern cfa = {};                       // of the flats
};

// Opens a shot and holds size, ISO, aperture and an exposure time against the first one's.
capture::RawFrame open_radiance_shot(RadianceSteps& steps, const RadianceShot& shot);

// Per sample: 1 clipped, 2 defect, else 0.
std::vector<std::uint8_t> marks_of(const capture::RawFrame& frame,
                                   const capture::RadianceCorrection& correction);

// Black at an exposure time.
std::array<double, 4> black_at(const capture::RadianceCorrection& correction, double exposure_s);

// Each fills its part of steps.calibration and throws InputError as calibrate_radiance() says.
void find_dark(RadianceSteps& steps);
void find_response_and_noise(RadianceSteps& steps);
void find_glare(RadianceSteps& steps);
void find_vignetting(RadianceSteps& steps);
void find_scale(RadianceSteps& steps);

}  // namespace scattermeter::calib
