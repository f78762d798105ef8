#include "apps/watching/awaited_file.h"

namespace scattermeter::apps {

std::vector<AwaitedFile> awaited_files(const Rig& rig) {
  std::vector<AwaitedFile> out;
  if (!rig.pose.board_shot.empty())
    out.push_back({rig.pose.board_shot, AwaitedFile::kBoard, 0, ""});
  for (std::size_t i = 0; i < rig.scene.shots.size(); ++i) {
    const std::vector<std::string> names = rig.scene.shots[i].files();
    for (std::size_t k = 0; k < names.size(); ++k) out.push_back({names[k], i, k, ""});
  }
  return out;
}

}  // namespace scattermeter::apps
