// A white rectangle as the rig states it.
#pragma once

#include "apps/rig/yaml_field.h"
#include "calib/led/white_plane.h"

namespace scattermeter::apps {

// From origin_mm, x_axis, y_axis, size_mm, albedo and albedo_relative_std of a map, which may hold
// more: the caller says what is allowed (YamlField::only). Throws InputError with file, line, field
// and value.
calib::WhitePlane read_white_plane(const YamlField& field, double default_albedo_relative_std);

}  // namespace scattermeter::apps
