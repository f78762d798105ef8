#include "capture/raw/decoded_frame.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "capture/raw/curve_levels.h"

namespace scattermeter::capture {
namespace {

constexpr int kBits = 12;  // of a stored code, as the writers store it

}  // namespace

RawFrame decoded_frame(int width_px, int height_px, const std::vector<std::uint16_t>& codes,
                       const RawMetadata& metadata) {
  if (width_px <= 0 || height_px <= 0 ||
      codes.size() != static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px)) {
    throw std::invalid_argument("decoded_frame: " + std::to_string(width_px) + " x " +
                                std::to_string(height_px) + " codes expected, got " +
                                std::to_string(codes.size()));
  }
  RawFrame frame;
  frame.width_px = width_px;
  frame.height_px = height_px;
  frame.samples = codes;
  const std::vector<std::uint16_t>& table = metadata.linearization_table;
  if (!table.empty()) {
    for (std::uint16_t& sample : frame.samples) {
      if (sample >= table.size()) {
        throw std::invalid_argument("decoded_frame: code " + std::to_string(sample) +
                                    " in a table of " + std::to_string(table.size()));
      }
      sample = table[sample];
    }
    frame.curve_levels = curve_levels(table, kBits, frame.samples);
  }
  frame.cfa = metadata.cfa;
  std::copy(metadata.black_counts.begin(), metadata.black_counts.end(), frame.black_counts.begin());
  frame.white_counts = metadata.white_counts;
  frame.exposure_s = metadata.exposure_s;
  frame.iso = metadata.iso;
  frame.f_number = metadata.f_number;
  frame.make = metadata.make;
  frame.model = metadata.model;
  return frame;
}

}  // namespace scattermeter::capture
