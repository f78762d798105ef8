// Sensor of the camera of simulated shots.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "capture/raw/raw_frame.h"
#include "capture/raw/raw_metadata.h"
#include "capture/sensor/sensor.h"
#include "capture/sensor/sensor_truth.h"
#include "core/scene/scene.h"

namespace scattermeter::capture {

// Exposes whole frames as the camera of the scene does, with the errors of its true sensor in this
// order: true exposure time, vignetting, glare (a share of the frame mean of the colour), dark
// current and hot pixels, photon noise, departure from linearity, read noise, black and its drift,
// codes. Without errors only noise and codes remain. Scene and truth must outlive it. All members
// are safe to call from several threads at once.
class VirtualSensor {
 public:
  VirtualSensor(const Scene& scene, const SensorTruth& truth, bool noise);

  // The seed of the random numbers of one shot, by its index or, independently of other shots, by
  // its file name.
  static std::uint64_t stream(std::uint64_t seed, std::size_t shot) {
    return seed * 1'000'003ULL + shot;
  }
  static std::uint64_t stream(std::uint64_t seed, const std::string& file);

  double true_exposure_s(double stated_s) const;
  // Counts above black of each pixel, in the channel of its filter, for the stated exposure time
  // and without the errors above: responsivity * radiance * stated_s. Throws InputError when the
  // camera has no responsivity.
  std::vector<float> signal_counts(const std::vector<float>& radiance_W_per_mm2_sr,
                                   double stated_s) const;

  // The stored codes of one exposure of such a signal. Throws std::invalid_argument unless it has
  // width_px * height_px values.
  std::vector<std::uint16_t> codes(const std::vector<float>& signal_counts, double stated_s,
                                   std::uint64_t stream) const;
  // The frame that read_raw() returns for the written file, except as in
  // capture/raw/decoded_frame.h.
  RawFrame frame(const std::vector<float>& signal_counts, double stated_s,
                 std::uint64_t stream) const;
  // Writes the raw file in the format of the truth, complete or not at all. Throws InputError
  // naming the file. Precondition: the camera is as its writer requires.
  void write(const std::string& path, const std::vector<float>& signal_counts, double stated_s,
             std::uint64_t stream) const;

  // Counts above black at which the first phase clips.
  double range_counts() const;

  SensorModel model() const;
  RawMetadata metadata(double stated_s) const;

 private:
  std::vector<float> on_sensor(std::vector<float> signal_counts, double stated_s) const;

  const Scene& scene_;
  const SceneCamera& camera_;
  const SensorTruth& truth_;
  bool noise_;
  std::vector<std::pair<std::size_t, float>> hot_;  // pixel index, counts per s
};

}  // namespace scattermeter::capture
