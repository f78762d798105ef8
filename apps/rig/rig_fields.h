// Kinds of values in a rig.
#pragma once

#include <array>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "apps/rig/yaml_field.h"
#include "calib/lens/board_shots.h"

namespace scattermeter::apps {

// Path of a file named in the rig; relative names are relative to the rig's folder.
std::string beside(const std::string& rig_path, const std::string& file);

// The same for the file that a field names; the field fails if there is none.
std::string file_beside(const std::string& rig_path, const YamlField& field);

// All throw InputError naming file, line, field and value.
std::string file_in_folder(const YamlField& field);  // the name of a file without a path
std::array<int, 2> integer_pair(const YamlField& field, int min, int max);
std::array<double, 3> positive_rgb(const YamlField& field);
std::array<double, 3> rgb_not_negative(const YamlField& field);
Eigen::Vector3d unit_vector(const YamlField& field);  // of any length but zero; normalised
Eigen::Array3d some_light(const YamlField& field);    // R, G, B of at least 0, not all of them 0
// position_mm, look_at_mm and the optional up of a camera.
calib::BoardViewpoint read_viewpoint(const YamlField& field);
// Requires the text of the field to be one of the names; suggests the nearest one in the message,
// which begins with `what`.
void require_name(const YamlField& field, const std::vector<std::string>& names,
                  const std::string& what);
// Refuses a length that is not 0 but less than any rig has there: it was meant in metres.
void require_mm(const YamlField& field, double length_mm, double shortest_mm);
// An exposure time that a raw file can state.
double exposure_time_s(const YamlField& field);
// Requires top.<key> to be 1. what: of which files, for the message ("rigs").
void require_version(const YamlField& top, const std::string& key, const std::string& what);

}  // namespace scattermeter::apps
