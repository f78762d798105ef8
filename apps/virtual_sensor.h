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

// Exposes whole pictures as the rig's camera does. The rig must outlive it. Everything may be
// called from several threads at once.
class VirtualSensor {
 public:
  VirtualSensor(const Rig& rig, bool noise) : rig_(rig), noise_(noise) {}

  // A stream of random numbers for one shot. By name: for files, whatever else is made with them.
  static std::uint64_t stream(std::uint64_t seed, std::size_t shot) {
    return seed * 1'000'003ULL + shot;
  }
  static std::uint64_t stream(std::uint64_t seed, const std::string& file);

  // One exposure of a signal (counts above black, in the channel of each pixel's filter); width_px
  // * height_px values of the camera's frame (std::invalid_argument).
  std::vector<std::uint16_t> codes(const std::vector<float>& signal_counts, double stated_s,
                                   std::uint64_t stream) const;
  // As the raw reader delivers the written file (exceptions: capture/decoded_frame.h).
  capture::RawFrame frame(const std::vector<float>& signal_counts, double stated_s,
                          std::uint64_t stream) const;
  // The 12-bit DNG; it appears complete or not at all. Throws InputError naming the file.
  void write(const std::string& path, const std::vector<float>& signal_counts, double stated_s,
             std::uint64_t stream) const;

  capture::SensorModel model() const;
  capture::DngMetadata metadata(double stated_s) const;

 private:
  const Rig& rig_;
  bool noise_;
};

}  // namespace scattermeter::apps
