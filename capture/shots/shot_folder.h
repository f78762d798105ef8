// The folder of raw shots against the scene's list.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "core/scene/scene.h"

namespace scattermeter::capture {

struct ShotFolder {
  // Of the scene's shots, in the scene's order, each with the files of its bracket.
  std::vector<std::vector<std::string>> paths;
  std::vector<std::string> unlisted;  // file names in the folder that nothing lists, sorted
};

// also_listed: files that the folder may hold besides the shots. Throws InputError when the folder
// is missing, no folder, or empty, or when shots that the rig
// lists are not in it (all of them named, with the rig's line of the first).
ShotFolder match_shots(const Scene& scene, const std::set<std::string>& also_listed,
                       const std::string& folder);

}  // namespace scattermeter::capture
