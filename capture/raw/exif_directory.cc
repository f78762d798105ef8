#include "capture/raw/exif_directory.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace scattermeter::capture {
namespace {

constexpr double kTwoTo32 = 4294967296.0;

enum TiffType : unsigned { kShort = 3, kRational = 5 };

void put(std::vector<std::uint8_t>& out, std::uint32_t value, int bytes) {
  for (int i = 0; i < bytes; ++i) out.push_back(static_cast<std::uint8_t>(value >> 8 * i));
}

void put_entry(std::vector<std::uint8_t>& out, unsigned tag, TiffType type, std::uint32_t value) {
  put(out, tag, 2);
  put(out, type, 2);
  put(out, 1, 4);
  put(out, value, 4);
}

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
                                         int iso) {
  constexpr std::uint32_t kEntries = 3;
  const std::uint32_t values_at = offset + 2 + 12 * kEntries + 4;
  std::vector<std::uint8_t> out;
  put(out, kEntries, 2);
  put_entry(out, 33434, kRational, values_at);      // ExposureTime
  put_entry(out, 33437, kRational, values_at + 8);  // FNumber
  put_entry(out, 34855, kShort, static_cast<std::uint32_t>(iso));
  put(out, 0, 4);
  for (const double value : {exposure_s, f_number}) {
    const Rational rational = nearest_rational(value);
    put(out, rational.numerator, 4);
    put(out, rational.denominator, 4);
  }
  return out;
}

}  // namespace scattermeter::capture
