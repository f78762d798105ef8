#include "apps/dipole_system.h"

#include <cmath>

#include "core/dipole_curve.h"
#include "core/numerics.h"

namespace scattermeter::apps {

DenseSystem dipole_system(const Rig& rig, const Task& task, const TaskRows& rows,
                          const Weights& weights, const DistanceKnots& knots,
                          const LitMedium& first,
                          const std::map<LightKey, TaskSensitivity>& sensitivities,
                          std::optional<double> patch_mm) {
  const double sigma_a = first.medium.sigma_a_per_mm;
  const double sigma_t = first.medium.sigma_s_prime_per_mm + sigma_a;
  DenseSystem system = system_of(rig, task, rows, weights, 1.0 / sigma_t, patch_mm);
  const DipoleCurve curve = dipole_curve(knots, std::log(sigma_t), sigma_a / sigma_t, task.eta);
  add_nuisances(rig, task.shots, rows, task.channel, sensitivities, system);
  add_numerics(knots, first.scale * curve.r, patch_mm.value_or(patch_size_mm(task)),
               {first.medium.sigma_s_prime_per_mm, sigma_a, task.eta}, system);
  return system;
}

}  // namespace scattermeter::apps
