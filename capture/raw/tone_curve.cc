#include "capture/raw/tone_curve.h"

#include <algorithm>
#include <cmath>

namespace scattermeter::capture {

// Unit steps up to v0, from there dv/dc = sqrt(v / v0), which meets the unit slope at v0. With
// s = sqrt(v0) the solution through (c, v) = (v0, v0) is sqrt(v) = s/2 + c/(2 s). The last code
// L = 682 decodes to the top V = 3880, so s^2 - 2 sqrt(V) s + L = 0; its smaller root gives
// v0 = 33 (the other would put v0 above V). The steps grow to 10.8 counts at the top, half the
// photon noise there at 6 electrons per count.
std::vector<std::uint16_t> nef_lossy_curve() {
  constexpr int kLastCode = 682;
  constexpr double kTop = 3880.0;
  const double s = std::sqrt(kTop) - std::sqrt(kTop - kLastCode);
  std::vector<std::uint16_t> curve;
  curve.reserve(kLastCode + 1);
  for (int code = 0; code <= kLastCode; ++code) {
    const double root = 0.5 * (s + code / s);
    // The slope is nowhere below one, so rounding cannot make two neighbours equal.
    const double value = code <= s * s ? code : root * root;
    curve.push_back(static_cast<std::uint16_t>(std::lround(value)));
  }
  return curve;
}

std::uint16_t nearest_code(const std::vector<std::uint16_t>& curve, double value_counts) {
  const auto above = std::lower_bound(curve.begin(), curve.end(), value_counts);
  if (above == curve.begin()) return 0;
  const auto below = above - 1;
  const bool take_above = above != curve.end() && *above - value_counts < value_counts - *below;
  return static_cast<std::uint16_t>((take_above ? above : below) - curve.begin());
}

}  // namespace scattermeter::capture
