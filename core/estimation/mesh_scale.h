// The uncertainty of the coefficients by that of the mesh's size.
#pragma once

#include "core/estimation/material_channel.h"
#include "core/fit/estimate.h"

namespace scattermeter {

// An object that is larger than its mesh by a factor 1 + s, with light and camera at the matching
// scale, looks like the mesh with coefficients that are larger by the same factor: lengths are
// known by their products with the coefficients alone. Widens deviations and 95 % intervals by the
// largest SceneObject::scale_relative_std of the channel's objects, common to both coefficients,
// and adds the budget's line "mesh scale".
void widen_by_mesh_scale(const MaterialChannel& channel, Estimate& estimate);

}  // namespace scattermeter
