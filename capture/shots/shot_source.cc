#include "capture/shots/shot_source.h"

#include <numeric>
#include <utility>

#include "capture/shots/raw_shot.h"

namespace scattermeter::capture {

std::vector<std::size_t> all_shots(const Scene& scene) {
  std::vector<std::size_t> idxs(scene.shots.size());
  std::iota(idxs.begin(), idxs.end(), std::size_t{0});
  return idxs;
}

ShotSource shots_in_files(const Scene& scene, const ShotDecoding& decoding,
                          const std::vector<std::vector<std::string>>& paths) {
  return {all_shots(scene), paths,
          FrameSource([&scene, &decoding, paths](std::size_t i, std::size_t k) {
            return open_shot(scene, decoding, paths.at(i).at(k));
          }),
          nullptr, nullptr};
}

ShotSource shots_from(const Scene& scene, std::vector<std::size_t> shot_idxs,
                      std::variant<FrameSource, SampleSource> open) {
  ShotSource source{std::move(shot_idxs), {}, std::move(open), nullptr, nullptr};
  for (std::size_t i : source.shot_idxs) source.names.push_back(scene.shots.at(i).files());
  return source;
}

ShotSource shown_to(const std::function<void(std::size_t, const RawFrame&)>& look,
                    const ShotSource& source) {
  ShotSource out = source;
  if (const auto* frames = std::get_if<FrameSource>(&source.open)) {
    out.open = FrameSource([look, frames](std::size_t shot_idx, std::size_t exposure_idx) {
      RawFrame frame = (*frames)(shot_idx, exposure_idx);
      if (exposure_idx == 0) look(shot_idx, frame);
      return frame;
    });
  }
  return out;
}

std::vector<RawFrame> frames_of(const SceneShot& shot, std::size_t shot_idx,
                                const FrameSource& frames) {
  std::vector<RawFrame> out;
  for (std::size_t k = 0; k <= shot.more_files.size(); ++k) out.push_back(frames(shot_idx, k));
  return out;
}

}  // namespace scattermeter::capture
