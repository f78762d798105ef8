#include "capture/shots/shot_source.h"

#include <future>
#include <map>
#include <memory>
#include <mutex>
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

ShotSource begun(const ShotSource& source, const std::vector<std::size_t>& shot_idxs) {
  const auto* frames = std::get_if<FrameSource>(&source.open);
  if (frames == nullptr || shot_idxs.empty()) return source;
  struct Ahead {
    std::mutex mutex;
    std::map<std::size_t, std::future<RawFrame>> frames;
  };
  const auto ahead = std::make_shared<Ahead>();
  for (const std::size_t i : shot_idxs) {
    ahead->frames[i] = std::async(std::launch::async, *frames, i, std::size_t{0});
  }
  ShotSource out = source;
  out.open = FrameSource([ahead, open = *frames](std::size_t shot_idx, std::size_t exposure_idx) {
    std::future<RawFrame> frame;
    if (exposure_idx == 0) {
      const std::lock_guard lock(ahead->mutex);
      const auto it = ahead->frames.find(shot_idx);
      if (it != ahead->frames.end()) std::swap(frame, it->second);
    }
    return frame.valid() ? frame.get() : open(shot_idx, exposure_idx);
  });
  return out;
}

std::vector<RawFrame> frames_of(const SceneShot& shot, std::size_t shot_idx,
                                const FrameSource& frames) {
  std::vector<RawFrame> out;
  for (std::size_t k = 0; k <= shot.more_files.size(); ++k) out.push_back(frames(shot_idx, k));
  return out;
}

}  // namespace scattermeter::capture
