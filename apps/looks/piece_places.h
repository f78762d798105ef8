// Pieces put where the shots show them.
#pragma once

#include <string>
#include <vector>

#include "apps/rig/rig.h"
#include "core/base/progress.h"

namespace scattermeter::apps {

// For every object that is to be found (SceneObject::to_be_found), in up to four of its shots, each
// under other lights where there are such: sets world_from_mesh to the position found, and
// position_std_mm to its standard deviation along the least certain axis, or that of the turn at a
// distance of the piece's size if that is larger. Returns one sentence for each. The points of a
// board shot must have been taken (calib::take_points_from_board_shot()). Throws InputError naming
// the line of the rig and the shots where a piece is not found.
std::vector<std::string> place_pieces(Rig& rig, const std::string& shots_folder,
                                      Progress* progress = nullptr);

}  // namespace scattermeter::apps
