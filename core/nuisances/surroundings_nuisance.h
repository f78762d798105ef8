// Change of an LED's image by the matt plane below the object.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/diffusion/distance_weights.h"
#include "core/light/incident_light.h"
#include "core/light/led.h"
#include "core/nuisances/light_sensitivity.h"
#include "core/scene/scene.h"
#include "core/scene/seen_object.h"

namespace scattermeter {

// Change of l by the plane on the rows of a view, per unit of albedo and W/sr of the LED's
// intensity: rows x media. First order in the albedo, by two ways: the LED's light that the plane
// reflects onto the object, and light that has left the object (by the dipole) and comes back.
// `direct`: the LED's own light on the object. Computed at some hundred places an eighth of the
// object apart and interpolated: within a tenth of itself where the dipole holds (test: against
// paths), in some hundredths of the time that the weights take. Zero for an LED below the plane; a
// face without a gap of air counts as one with a gap that reflects nothing.
Eigen::MatrixXd change_by_plane(const SeenObject& seen, const Led& led, const IncidentLight& direct,
                                const ScenePlane& plane, const DistanceKnots& knots,
                                const std::vector<LitMedium>& media);

}  // namespace scattermeter
