#include "capture/sensor/radiance_calibration.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

namespace scattermeter::capture {

std::vector<RadiancePoint> radiance_points(const std::vector<double>& counts,
                                           const std::vector<double>& values,
                                           std::size_t min_samples) {
  if (counts.size() != values.size()) {
    throw std::invalid_argument("radiance_points: " + std::to_string(counts.size()) + " counts, " +
                                std::to_string(values.size()) + " values");
  }
  struct Sums {
    double n = 0, counts = 0, value = 0, squares = 0;
  };
  std::map<int, Sums> bins;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (!(counts[i] > 0.0) || !std::isfinite(values[i])) continue;
    Sums& s = bins[static_cast<int>(std::floor(2.0 * std::log2(counts[i])))];
    s.n += 1.0;
    s.counts += counts[i];
    // Running mean and squares about it (B. P. Welford, Technometrics 4, 419, 1962).
    const double off = values[i] - s.value;
    s.value += off / s.n;
    s.squares += off * (values[i] - s.value);
  }
  std::vector<RadiancePoint> out;
  for (const auto& [bin, s] : bins) {
    if (s.n < static_cast<double>(std::max<std::size_t>(2, min_samples))) continue;
    out.push_back({s.counts / s.n, s.value, std::sqrt(s.squares / (s.n - 1.0) / s.n)});
  }
  return out;
}

}  // namespace scattermeter::capture
