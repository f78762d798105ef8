#include "capture/raw/raw_metadata.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace scattermeter::capture {
namespace {

constexpr int kMaxCode = 4095;

void check_levels_and_exposure(const std::string& caller, const RawMetadata& metadata) {
  const auto refuse = [&](const std::string& what) {
    throw std::invalid_argument(caller + ": " + what);
  };
  if (metadata.make.empty() || metadata.model.empty()) refuse("make and model must not be empty");
  if (metadata.white_counts < 1 || metadata.white_counts > 65535) {
    refuse("white_counts must lie in 1 .. 65535, got " + std::to_string(metadata.white_counts));
  }
  for (const int black : metadata.black_counts) {
    if (black < 0 || black >= metadata.white_counts) {
      refuse("black_counts must lie in 0 .. white_counts - 1, got " + std::to_string(black));
    }
  }
  const auto positive = [](double value) { return std::isfinite(value) && value > 0; };
  if (!positive(metadata.exposure_s)) {
    refuse("exposure_s must be positive, got " + std::to_string(metadata.exposure_s));
  }
  if (!positive(metadata.f_number)) {
    refuse("f_number must be positive, got " + std::to_string(metadata.f_number));
  }
  // 65535 means "larger" in EXIF.
  if (metadata.iso < 1 || metadata.iso > 65534) {
    refuse("iso must lie in 1 .. 65534, got " + std::to_string(metadata.iso));
  }
  if (metadata.linearization_table.size() > kMaxCode + 1) {
    refuse("linearization_table must have at most 4096 entries, got " +
           std::to_string(metadata.linearization_table.size()));
  }
}

}  // namespace

void check_raw(const std::string& caller, int width_px, int height_px,
               const std::vector<std::uint16_t>& codes, const RawMetadata& metadata) {
  const auto refuse = [&](const std::string& what) {
    throw std::invalid_argument(caller + ": " + what);
  };
  const std::string size = std::to_string(width_px) + " x " + std::to_string(height_px);
  if (width_px <= 0 || height_px <= 0 || width_px % 2 != 0 || height_px % 2 != 0 ||
      width_px > kMaxRawSide_px || height_px > kMaxRawSide_px) {
    refuse("sides must be positive, even and at most " + std::to_string(kMaxRawSide_px) + ", got " +
           size);
  }
  if (codes.size() != static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px)) {
    refuse(size + " samples expected, got " + std::to_string(codes.size()));
  }
  check_levels_and_exposure(caller, metadata);
  const int top_code = metadata.linearization_table.empty()
                           ? kMaxCode
                           : static_cast<int>(metadata.linearization_table.size()) - 1;
  const int largest = *std::max_element(codes.begin(), codes.end());
  if (largest > top_code) {
    refuse("code " + std::to_string(largest) + " is above the largest allowed, " +
           std::to_string(top_code));
  }
}

}  // namespace scattermeter::capture
