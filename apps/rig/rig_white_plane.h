// Reading of a white rectangle.
#pragma once

#include "apps/rig/yaml_field.h"
#include "calib/led/white_plane.h"

namespace scattermeter::apps {

// Reads origin_mm, x_axis, y_axis, size_mm, albedo and albedo_relative_std of a map. The caller
// checks for other keys (YamlField::only). Throws InputError with file, line, field and value.
calib::WhitePlane read_white_plane(const YamlField& field, double default_albedo_relative_std);

}  // namespace scattermeter::apps
