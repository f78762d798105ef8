// The steps of a radiance calibration, in their order.
#pragma once

#include <cstdint>
#include <vector>

#include "apps/calibrate_radiance.h"
#include "calib/frame_blocks.h"
#include "calib/response_fit.h"

namespace scattermeter::apps {

// What one step leaves for the next.
struct RadianceSteps {
  const Rig& rig;
  const RadianceFrameSource& open;
  RadianceResult& result;
  // Of the flats, by find_response_and_noise().
  std::vector<calib::Block> blocks;
  struct Light {
    double per_s = 0;  // light of a block, counts a stated second; 0: unknown
    double relative_variance = 0;
    double samples = 0;
    Eigen::VectorXd shared = {};  // calib::FlatLight::shared: curve and exposure times
  };
  std::vector<Light> light = {};             // of each block
  std::vector<double> settings_s = {};       // stated times, as in the next
  Eigen::MatrixXd response_covariance = {};  // calib::ResponseFit::joint_covariance
  double shot_std = 0;                       // calib::ResponseFit::shot_std
  capture::CfaPattern cfa = {};              // of the flats
};

// Opens a shot and holds size, ISO, aperture and an exposure time against the first one's.
capture::RawFrame open_radiance_shot(RadianceSteps& steps, const RadianceShot& shot);

// Per sample: 1 clipped, 2 defect, else 0.
std::vector<std::uint8_t> marks_of(const capture::RawFrame& frame,
                                   const capture::RadianceCorrection& correction);

// Black at an exposure time.
std::array<double, 4> black_at(const capture::RadianceCorrection& correction, double exposure_s);

// Each fills its part of steps.result and throws InputError as calibrate_radiance() says.
void find_dark(RadianceSteps& steps);
void find_response_and_noise(RadianceSteps& steps);
void find_glare(RadianceSteps& steps);
void find_vignetting(RadianceSteps& steps);
void find_scale(RadianceSteps& steps);

}  // namespace scattermeter::apps
