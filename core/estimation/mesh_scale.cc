#include "core/estimation/mesh_scale.h"

#include <algorithm>

namespace scattermeter {

void widen_by_mesh_scale(const MaterialChannel& channel, Estimate& estimate) {
  double relative = 0.0;
  for (const ObservedShot* shot : channel.shots) {
    relative = std::max(relative, shot->seen->object->stated->scale_relative_std);
  }
  if (!(relative > 0.0)) return;
  const double by_s = relative * estimate.sigma_s_prime_per_mm.value;
  const double by_a = relative * estimate.sigma_a_per_mm.value;
  widen({"mesh scale", by_s, by_a}, by_s * by_a, estimate);
}

}  // namespace scattermeter
