// Advice on exposure times: shots that will be too dark or too bright.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "apps/instrument/open_shots.h"
#include "apps/rig/rig.h"
#include "apps/simulation/virtual_shots.h"
#include "capture/sensor/noise_model.h"
#include "core/camera/cfa_samples.h"
#include "core/camera/sensor_noise.h"

namespace scattermeter::apps {

// For one shot in one channel. Counts are above black, of the samples in rows of the object.
struct ExposureAdvice {
  std::string shot;
  std::string material;
  char channel = 'R';
  std::vector<double> exposure_s;  // of its files; as chosen if the rig has none
  bool chosen = false;             // the rig states no time
  double range_counts = 0;         // at which the sensor clips
  // In the first file.
  double brightest_counts = 0;
  double dark_counts = 0;    // a tenth of the samples is darker
  double clipped_share = 0;  // in all files
  double dark_share = 0;     // below three deviations of their noise in every file
  // For the shot, the same in its channels: one time, or a bracket from short to long. Empty if the
  // rig has no responsivity, so that the brightness of a shot is unknown.
  std::vector<double> suggested_s;
  std::string advice;  // a sentence; empty if nothing is wrong
};

// opened: all shots of `shots`, in the rig's order. noise: of the sensor, by channel.
std::vector<ExposureAdvice> exposure_advice(const Rig& rig, const VirtualShots& shots,
                                            const std::vector<ObservedShot>& opened,
                                            const std::array<SensorNoise, kRgb>& noise,
                                            double range_counts);

}  // namespace scattermeter::apps
