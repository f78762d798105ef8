// The matt plane below the objects, as stated or as it is assumed to be.
#pragma once

#include <memory>

#include "core/light/entry_source.h"
#include "core/scene/object_scene.h"
#include "core/scene/scene.h"

namespace scattermeter {

// The scene's plane; failing that, a stand that the rig does not mention: black, right below the
// object's lowest point, of albedo 0.04 +- 0.04 (matt black paint and paper: 0.03 to 0.06; velvet:
// below 0.01).
ScenePlane plane_below(const Scene& scene, const ObjectScene& object);

// Source of the light's paths into an object above a plane, through a smooth surface or one of this
// roughness (RoughBoundary). An LED's light that meets the plane
// first is included; a picture of the surroundings already shows the plane.
std::unique_ptr<EntrySource> entry_above(const SceneLight& light, const RayScene& scene,
                                         double eta_int_over_ext, int channel,
                                         const DiffusePlane& plane, double surface_alpha = 0.0);

// Throws InputError where the scene's plane is not below all objects and all LEDs of the shots, or
// where the contact is stated (not air) and no face of an object lies on the plane.
void require_above_plane(const Scene& scene, const ObjectScenes& objects);

}  // namespace scattermeter
