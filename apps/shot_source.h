// Where a measurement gets its shots from.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "apps/rig.h"
#include "capture/raw_frame.h"
#include "core/cfa_samples.h"
#include "core/sample_map.h"

namespace scattermeter::apps {

class FileDigests;
class ShotCache;

// Both are called from several threads at once. `shot_idx`: place in the rig's list of shots;
// `exposure_idx`: in RigShot::files(), 0 but in a bracket.
using FrameSource =
    std::function<capture::RawFrame(std::size_t shot_idx, std::size_t exposure_idx)>;
// The samples of the map's rectangle, past any raw frame: only for a pose from the rig's points.
using SampleSource = std::function<CfaSamples(std::size_t shot_idx, const SampleMap& where)>;

struct ShotSource {
  std::vector<std::size_t> shot_idxs;  // which of the rig's shots
  // Of the same and each one's exposures, for messages: a path, or the rig's file name.
  std::vector<std::vector<std::string>> names;
  std::variant<FrameSource, SampleSource> open;
  // Where what was decoded is kept, and the digests of files; both or none. The names are paths,
  // then.
  ShotCache* cache = nullptr;
  FileDigests* digests = nullptr;
};

// All shots of the rig from raw files. paths: of each shot of the rig, in its order, one for each
// of its exposures.
ShotSource shots_in_files(const Rig& rig, const std::vector<std::vector<std::string>>& paths);

// Some shots of the rig, each named as in the rig.
ShotSource shots_from(const Rig& rig, std::vector<std::size_t> shot_idxs,
                      std::variant<FrameSource, SampleSource> open);

// 0, 1 ... : every shot of the rig.
std::vector<std::size_t> all_shots(const Rig& rig);

}  // namespace scattermeter::apps
