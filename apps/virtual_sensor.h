// The camera of simulated shots: the one place where light becomes codes.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/rig.h"
#include "capture/dng_writer.h"
#include "capture/raw_frame.h"
#include "capture/sensor.h"

namespace scattermeter::apps {

// Exposes whole pictures as the rig's camera does, with what truth.sensor says: light takes the
// true exposure time, the vignetting, then the glare (every pixel gets the stated share of the
// frame's mean of its colour); dark current and hot pixels join; photon noise, departure from
// linearity, read noise, black and its drift, codes. Without truth.sensor: noise and codes only.
// The rig must outlive it. Everything may be called from several threads at once.
class VirtualSensor {
 public:
  VirtualSensor(const Rig& rig, bool noise);

  // A stream of random numbers for one shot. By name: for files, whatever else is made with them.
  static std::uint64_t stream(std::uint64_t seed, std::size_t shot) {
    return seed * 1'000'003ULL + shot;
  }
  static std::uint64_t stream(std::uint64_t seed, const std::string& file);

  double true_exposure_s(double stated_s) const;
  // Counts above black per pixel, in the channel of its filter, for the stated exposure time, with
  // nothing of the above: responsivity * radiance * stated_s.
  // Throws InputError where the rig has no responsivity.
  std::vector<float> signal_counts(const std::vector<float>& radiance_W_per_mm2_sr,
                                   double stated_s) const;

  // One exposure of such a signal; width_px * height_px values of the camera's frame
  // (std::invalid_argument).
  std::vector<std::uint16_t> codes(const std::vector<float>& signal_counts, double stated_s,
                                   std::uint64_t stream) const;
  // As the raw reader delivers the written file (exceptions: capture/decoded_frame.h).
  capture::RawFrame frame(const std::vector<float>& signal_counts, double stated_s,
                          std::uint64_t stream) const;
  // The 12-bit DNG; it appears complete or not at all. Throws InputError naming the file.
  void write(const std::string& path, const std::vector<float>& signal_counts, double stated_s,
             std::uint64_t stream) const;

  // Counts above black at which the first of the phases clips.
  double range_counts() const;

  capture::SensorModel model() const;
  capture::DngMetadata metadata(double stated_s) const;

 private:
  std::vector<float> on_sensor(std::vector<float> signal_counts, double stated_s) const;

  const Rig& rig_;
  bool noise_;
  std::vector<std::pair<std::size_t, float>> hot_;  // pixel, counts per s
};

}  // namespace scattermeter::apps
