// Kinds of values that a rig is made of.
#pragma once

#include <array>
#include <string>

#include <Eigen/Core>

#include "apps/rig/yaml_field.h"

namespace scattermeter::apps {

// A file named in the rig: relative names are beside it.
std::string beside(const std::string& rig_path, const std::string& file);

// All throw InputError naming file, line, field and value.
std::string file_in_folder(const YamlField& field);  // a file's name without a path
std::array<double, 3> positive_rgb(const YamlField& field);
std::array<double, 3> rgb_not_negative(const YamlField& field);
Eigen::Vector3d unit_vector(const YamlField& field);  // of any length but zero; normalised

}  // namespace scattermeter::apps
