#include "apps/shot_source.h"

#include <numeric>
#include <utility>

#include "apps/raw_shot.h"

namespace scattermeter::apps {

std::vector<std::size_t> all_shots(const Rig& rig) {
  std::vector<std::size_t> idxs(rig.shots.size());
  std::iota(idxs.begin(), idxs.end(), std::size_t{0});
  return idxs;
}

ShotSource shots_in_files(const Rig& rig, const std::vector<std::vector<std::string>>& paths) {
  return {all_shots(rig), paths, FrameSource([&rig, paths](std::size_t i, std::size_t k) {
            return open_shot(rig, paths.at(i).at(k));
          }),
          nullptr, nullptr};
}

ShotSource shots_from(const Rig& rig, std::vector<std::size_t> shot_idxs,
                      std::variant<FrameSource, SampleSource> open) {
  ShotSource source{std::move(shot_idxs), {}, std::move(open), nullptr, nullptr};
  for (std::size_t i : source.shot_idxs) source.names.push_back(rig.shots.at(i).files());
  return source;
}

}  // namespace scattermeter::apps
