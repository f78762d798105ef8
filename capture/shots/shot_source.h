// Where a measurement gets its shots from.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "capture/raw/raw_frame.h"
#include "capture/shots/shot_decoding.h"
#include "core/camera/cfa_samples.h"
#include "core/scene/scene.h"
#include "core/view/sample_map.h"

namespace scattermeter::capture {

class FileDigests;
class ShotCache;

// Both are called from several threads at once. `shot_idx`: place in the scene's list of shots;
// `exposure_idx`: in SceneShot::files(), 0 but in a bracket.
using FrameSource = std::function<RawFrame(std::size_t shot_idx, std::size_t exposure_idx)>;
// The samples of the map's rectangle, past any raw frame: only for a pose from points.
using SampleSource = std::function<CfaSamples(std::size_t shot_idx, const SampleMap& where)>;

struct ShotSource {
  std::vector<std::size_t> shot_idxs;  // which of the scene's shots
  // Of the same and each one's exposures, for messages: a path, or the scene's file name.
  std::vector<std::vector<std::string>> names;
  std::variant<FrameSource, SampleSource> open;
  // Where what was decoded is kept, and the digests of files; both or none. The names are paths,
  // then.
  ShotCache* cache = nullptr;
  FileDigests* digests = nullptr;
};

// All shots of the scene from raw files. Scene and decoding must outlive it. paths: of each shot,
// in its order, one for each of its exposures.
ShotSource shots_in_files(const Scene& scene, const ShotDecoding& decoding,
                          const std::vector<std::vector<std::string>>& paths);

// Some shots of the scene, each named as there.
ShotSource shots_from(const Scene& scene, std::vector<std::size_t> shot_idxs,
                      std::variant<FrameSource, SampleSource> open);

// 0, 1 ... : every shot of the scene.
std::vector<std::size_t> all_shots(const Scene& scene);

// All frames of a shot, in the order of SceneShot::files().
std::vector<RawFrame> frames_of(const SceneShot& shot, std::size_t shot_idx,
                                const FrameSource& frames);

}  // namespace scattermeter::capture
