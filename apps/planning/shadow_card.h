// A card that shadows half of an object.
#pragma once

#include <memory>

#include <Eigen/Core>

#include "apps/instrument/open_objects.h"
#include "core/mesh/ray_scene.h"

namespace scattermeter::apps {

// The object and a card between it and a lamp at `lamp_mm`, whose edge lies in one plane with lamp
// and middle of the object; upright: in the plane that holds the world's z as well, else across
// it. For shadows only. Null where the lamp is too near for a card.
std::unique_ptr<RayScene> with_shadow_card(const ObjectScene& object,
                                           const Eigen::Vector3d& lamp_mm, bool upright);

}  // namespace scattermeter::apps
