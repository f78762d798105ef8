// The folder of raw shots against the rig's list.
#pragma once

#include <string>
#include <vector>

#include "apps/rig.h"

namespace scattermeter::apps {

struct ShotFolder {
  // Of the rig's shots, in the rig's order, each with the files of its bracket.
  std::vector<std::vector<std::string>> paths;
  std::vector<std::string> unlisted;  // file names in the folder that the rig does not list, sorted
};

// Throws InputError when the folder is missing, no folder, or empty, or when shots that the rig
// lists are not in it (all of them named, with the rig's line of the first).
ShotFolder match_shots(const Rig& rig, const std::string& folder);

}  // namespace scattermeter::apps
