// The LED of a scene from a dictionary of Python's `estimate`.
#pragma once

#include <string>

#include <pybind11/pybind11.h>

#include "core/scene/scene.h"

namespace scattermeter::python {

// Keys and units as `estimate` documents them; deviations that are missing are those of a careful
// user's rig (core/scene/default_uncertainty.h). Throws InputError naming lights.NAME.key.
SceneLight scene_light(const std::string& name, const pybind11::dict& dict);

}  // namespace scattermeter::python
