// Simulated shots of a rig's calibration.led: rendered once, exposed as often as needed.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/rig/rig.h"
#include "capture/raw/raw_frame.h"
#include "capture/sensor/virtual_sensor.h"

namespace scattermeter::apps {

// The rig's values are the truth. The rig must outlive it. Const members may be called from several
// threads at once.
class VirtualLedShots {
 public:
  // Renders every shot (apps/simulation/led_picture.h). A rig without responsivity has the nominal
  // one (calib/led/led_shots.h). A shot without exposure_s is exposed so that its brightest sample
  // reaches three quarters of the range, an ambient one like the first shot of its plane.
  // Precondition: the rig has calibration.led. Throws InputError for a light that is not an LED of
  // the rig, and for a missing pose.
  VirtualLedShots(const Rig& rig, bool noise);

  std::size_t size() const { return counts_.size(); }
  double exposure_s(std::size_t shot) const { return exposure_s_.at(shot); }
  // Expected signal above black of the whole frame, without noise; may be changed (dust, shadows).
  const std::vector<float>& counts(std::size_t shot) const { return counts_.at(shot); }
  std::vector<float>& counts(std::size_t shot) { return counts_.at(shot); }

  // One exposure; each shot has its own random stream of the seed.
  capture::RawFrame frame(std::size_t shot, std::uint64_t seed) const;
  void write(std::size_t shot, std::uint64_t seed, const std::string& path) const;

 private:
  std::uint64_t stream(std::size_t shot, std::uint64_t seed) const;

  const Rig& rig_;
  capture::VirtualSensor sensor_;
  std::vector<std::vector<float>> counts_;
  std::vector<double> exposure_s_;
};

}  // namespace scattermeter::apps
