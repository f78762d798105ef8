#include "capture/raw/exif_directory.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace scattermeter::capture {
namespace {

constexpr double kTwoTo32 = 4294967296.0;

}  // namespace

Rational nearest_rational(double value) {
  if (!(value > 1 / kTwoTo32 && value < kTwoTo32)) {
    throw std::invalid_argument("nearest_rational: the value must lie in 2^-32 .. 2^32, got " +
                                std::to_string(value));
  }
  // Convergents n / d of the continued fraction; the next partial quotient is the floor of `rest`.
  double n = 1, n_before = 0;
  double d = 0, d_before = 1;
  for (double rest = value;;) {
    const double quotient = std::floor(rest);
    const double n_next = quotient * n + n_before;
    const double d_next = quotient * d + d_before;
    if (n_next >= kTwoTo32 || d_next >= kTwoTo32) break;
    n_before = n;
    d_before = d;
    n = n_next;
    d = d_next;
    if (std::abs(n / d - value) <= 1e-15 * value || rest == quotient) break;
    rest = 1 / (rest - quotient);
  }
  // For a value just above 2^-32 the only convergent that fits is 0/1.
  if (n == 0) return {1, static_cast<std::uint32_t>(std::min(std::round(1 / value), kTwoTo32 - 1))};
  return {static_cast<std::uint32_t>(n), static_cast<std::uint32_t>(d)};
}

std::vector<std::uint8_t> exif_directory(std::uint32_t offset, double exposure_s, double f_number,
                                         int iso, ByteOrder order,
                                         const std::vector<std::uint8_t>& maker_note) {
  IfdBytes directory(order);
  directory.rationals(33434, {nearest_rational(exposure_s)});       // ExposureTime
  directory.rationals(33437, {nearest_rational(f_number)});         // FNumber
  directory.shorts(34855, {static_cast<std::uint16_t>(iso)});       // ISOSpeedRatings
  if (!maker_note.empty()) directory.undefined(37500, maker_note);  // MakerNote
  return directory.at(offset);
}

}  // namespace scattermeter::capture
