// What a measurement takes from the files of a shot, and what a cache keeps of it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "apps/shot_samples.h"
#include "core/observation.h"

namespace scattermeter::apps {

struct DecodedShot {
  Observation observation;
  double exposure_s = 0;  // in whose counts the shot is told; of a bracket the first one's
  double iso = 0;
  double f_number = 0;
  std::vector<ShotExposure> exposures;           // as observation's; empty for a SampleSource
  std::array<double, kRgb> frame_mean_counts{};  // of which glare is a share
};

// As CBOR (RFC 8949), numbers bit by bit.
std::vector<std::uint8_t> to_bytes(const DecodedShot& shot);
// Empty for bytes that are no shot: cut short, of another kind, lists of different length.
std::optional<DecodedShot> decoded_shot(std::span<const std::uint8_t> bytes);

}  // namespace scattermeter::apps
