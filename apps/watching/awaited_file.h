// The files that a rig expects.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "apps/rig/rig.h"

namespace scattermeter::apps {

// A file that the rig lists: one exposure of a shot, or the shot of the board.
struct AwaitedFile {
  std::string rig_name;
  std::size_t shot_idx = kBoard;  // into the rig's shots
  std::size_t exposure_idx = 0;
  std::string taken_from;  // the file that was accepted for it; "": still to be taken
  static constexpr std::size_t kBoard = static_cast<std::size_t>(-1);
};

// The shot of the board, if the rig names one, then every exposure of every shot in the rig's
// order.
std::vector<AwaitedFile> awaited_files(const Rig& rig);

}  // namespace scattermeter::apps
