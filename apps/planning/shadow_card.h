// A card that shadows half of an object.
#pragma once

#include <memory>

#include <Eigen/Core>

#include "apps/rig/open_objects.h"
#include "core/mesh/ray_scene.h"

namespace scattermeter::apps {

// The object and a card between it and a lamp at `lamp_mm`. The plane through the edge of the card
// and the lamp contains the centre of the object; upright: it also contains the world's z axis,
// otherwise it is perpendicular to that plane. For shadows only. Null if the lamp is too close for
// a card.
std::unique_ptr<RayScene> with_shadow_card(const ObjectScene& object,
                                           const Eigen::Vector3d& lamp_mm, bool upright);

}  // namespace scattermeter::apps
