// Simulated shots of a rig's calibration.radiance.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "apps/rig/rig.h"
#include "capture/raw/raw_frame.h"
#include "capture/sensor/virtual_sensor.h"

namespace scattermeter::apps {

// All shots: dark, flats, white, glare, in this order.
std::vector<calib::RadianceShot> all_radiance_shots(
    const calib::RadianceCalibrationShots& radiance);

// The rig must outlive it. Const members may be called from several threads at once.
class RadianceShots {
 public:
  // Throws InputError for what the rig lacks: exposure times, flat_radiance, a white plane in view,
  // glare.bright_px and its radiance, a responsivity.
  RadianceShots(const Rig& rig, bool noise);
  RadianceShots(const RadianceShots&) = delete;
  RadianceShots& operator=(const RadianceShots&) = delete;

  double exposure_s(const calib::RadianceShot& shot) const;
  // One exposure; the same seed and file name give the same codes.
  capture::RawFrame frame(const calib::RadianceShot& shot, std::uint64_t seed) const;
  void write(const calib::RadianceShot& shot, std::uint64_t seed, const std::string& path) const;

 private:
  std::vector<float> signal_counts(const calib::RadianceShot& shot) const;

  const Rig& rig_;
  capture::VirtualSensor sensor_;
  std::map<std::string, double> lamp_;                           // of flats, by file
  std::map<std::string, const std::vector<float>*> picture_of_;  // of white and glare, by file
  std::vector<float> white_, glare_;                             // radiance
};

}  // namespace scattermeter::apps
