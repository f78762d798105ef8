#include "calib/radiance/glare_fit.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace scattermeter::calib {

GlareFit fit_glare(const std::vector<TrapMean>& traps, double model_relative_std) {
  GlareFit out;
  double weight = 0, sum = 0;
  for (const TrapMean& t : traps) {
    if (!(t.std_counts > 0.0)) {
      throw std::invalid_argument("fit_glare: std_counts " + std::to_string(t.std_counts));
    }
    if (!(t.frame_counts > 0.0)) continue;
    const double w = t.frame_counts * t.frame_counts / (t.std_counts * t.std_counts);
    weight += w;
    sum += w * t.counts / t.frame_counts;
  }
  if (!(weight > 0.0)) return out;
  const double share = sum / weight;
  double chi2 = 0, scatter = 0, squares = 0, n = 0;
  for (const TrapMean& t : traps) {
    if (!(t.frame_counts > 0.0)) continue;
    const double r = t.counts - share * t.frame_counts;
    chi2 += r * r / (t.std_counts * t.std_counts);
    scatter += r * r / (t.frame_counts * t.frame_counts);
    squares += r * r;
    out.worst_counts = std::max(out.worst_counts, std::abs(r));
    n += 1.0;
  }
  out.rms_counts = std::sqrt(squares / n);
  double variance = 1.0 / weight;
  if (n > 1.0 && chi2 > n - 1.0 + 3.0 * std::sqrt(2.0 * (n - 1.0))) variance += scatter / (n - 1.0);
  out.share = std::max(0.0, share);
  const double model = model_relative_std * out.share;
  out.std = std::sqrt(variance + model * model);
  out.ok = true;
  return out;
}

}  // namespace scattermeter::calib
