// Reading of an LED's lobe as a table.
#pragma once

#include <memory>

#include "apps/rig/yaml_field.h"
#include "core/light/led_lobe.h"

namespace scattermeter::apps {

// {angle_deg: [...], relative: [...]}, or {angle_deg, relative_x, relative_y, x_axis} for two
// planes; conditions as for LobeTable. axis: the LED's, unit length. Throws InputError with file,
// line, field and value.
std::shared_ptr<const LobeTable> read_lobe(const YamlField& field, const Eigen::Vector3d& axis);

}  // namespace scattermeter::apps
