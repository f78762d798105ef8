// Matching of a folder of raw shots to the shots that the scene lists.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "core/scene/scene.h"

namespace scattermeter::capture {

struct ShotFolder {
  // For each shot of the scene, in the order of the scene, the files of its bracket.
  std::vector<std::vector<std::string>> paths;
  std::vector<std::string> unlisted;  // names of files in the folder that are not listed, sorted
};

// The names of the files in a folder of shots, without hidden ones; at least one. Throws InputError
// when the folder is missing, empty, unreadable or not a folder.
std::set<std::string> files_of_shots(const std::string& folder);

// also_listed: files that the folder may contain besides the shots. Throws InputError when the
// folder is missing, empty or not a folder, or when listed shots are not in it (naming all of them
// and the line in the rig of the first).
ShotFolder match_shots(const Scene& scene, const std::set<std::string>& also_listed,
                       const std::string& folder);

}  // namespace scattermeter::capture
