// The source of the shots of a measurement.
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

// Both functions are called from several threads at once. `shot_idx` is an index into the scene's
// list of shots, `exposure_idx` into SceneShot::files(), 0 except in a bracket.
using FrameSource = std::function<RawFrame(std::size_t shot_idx, std::size_t exposure_idx)>;
// The samples of the map's rectangle without any raw frame; only for a pose from points.
using SampleSource = std::function<CfaSamples(std::size_t shot_idx, const SampleMap& where)>;

struct ShotSource {
  std::vector<std::size_t> shot_idxs;  // which of the scene's shots
  // For each of these shots and each of its exposures a name for messages: a path, or the file name
  // in the scene.
  std::vector<std::vector<std::string>> names;
  std::variant<FrameSource, SampleSource> open;
  // The cache of decoded shots and the digests of files: both or neither. With them the names are
  // paths.
  ShotCache* cache = nullptr;
  FileDigests* digests = nullptr;
};

// All shots of the scene from raw files. Scene and decoding must outlive the source. paths: for
// each shot of the scene, in order, one path per exposure.
ShotSource shots_in_files(const Scene& scene, const ShotDecoding& decoding,
                          const std::vector<std::vector<std::string>>& paths);

// Some shots of the scene, with their file names in the scene.
ShotSource shots_from(const Scene& scene, std::vector<std::size_t> shot_idxs,
                      std::variant<FrameSource, SampleSource> open);

// The same source, which shows the first frame of each shot that it opens to `look`, from several
// threads at once. Shots that a cache has are not opened. `source` must outlive it.
ShotSource shown_to(const std::function<void(std::size_t shot_idx, const RawFrame&)>& look,
                    const ShotSource& source);

// The same source, while these shots' first frames are being decoded from now on, each by a thread
// of its own, as others prepare what they need to look at them. What `source` refers to must
// outlive it.
ShotSource begun(const ShotSource& source, const std::vector<std::size_t>& shot_idxs);

// The indices 0, 1, ... of all shots of the scene.
std::vector<std::size_t> all_shots(const Scene& scene);

// All frames of a shot, in the order of SceneShot::files().
std::vector<RawFrame> frames_of(const SceneShot& shot, std::size_t shot_idx,
                                const FrameSource& frames);

}  // namespace scattermeter::capture
