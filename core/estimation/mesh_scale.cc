#include "core/estimation/mesh_scale.h"

#include <algorithm>
#include <cmath>

namespace scattermeter {

void widen_by_mesh_scale(const MaterialChannel& channel, Estimate& estimate) {
  double relative = 0.0;
  for (const ObservedShot* shot : channel.shots) {
    relative = std::max(relative, shot->seen->object->stated->scale_relative_std);
  }
  if (!(relative > 0.0)) return;
  Quantity& s = estimate.sigma_s_prime_per_mm;
  Quantity& a = estimate.sigma_a_per_mm;
  const double by_s = relative * s.value;
  const double by_a = relative * a.value;
  const double covariance = estimate.correlation * s.std * a.std + by_s * by_a;
  const auto widen = [](Quantity& q, double by) {
    const double factor = q.std > 0.0 ? std::hypot(q.std, by) / q.std : 1.0;
    q.std = std::hypot(q.std, by);
    q.low95 = std::max(0.0, q.value - factor * (q.value - q.low95));
    q.high95 = q.value + factor * (q.high95 - q.value);
  };
  widen(s, by_s);
  widen(a, by_a);
  if (s.std > 0.0 && a.std > 0.0) estimate.correlation = covariance / (s.std * a.std);
  estimate.budget.push_back({"mesh scale", by_s, by_a});
}

}  // namespace scattermeter
