// The linear system that the dipole is fitted to.
#pragma once

#include <map>
#include <optional>

#include "apps/estimation_task.h"
#include "apps/nuisances.h"
#include "core/distance_weights.h"
#include "core/linear_shot.h"

namespace scattermeter::apps {

// The used rows of the task under all their lights, with all that the rig knows only to a standard
// deviation (apps/nuisances.h) and with the errors of the method (core/numerics.h). first: the
// material as known so far, for which both are computed. sensitivities: of every view and light of
// the task. patch_mm: of the patches whose errors these are; absent: the task's.
DenseSystem dipole_system(const Rig& rig, const Task& task, const TaskRows& rows,
                          const Weights& weights, const DistanceKnots& knots,
                          const LitMedium& first,
                          const std::map<LightKey, TaskSensitivity>& sensitivities,
                          std::optional<double> patch_mm = std::nullopt);

}  // namespace scattermeter::apps
