#include "apps/looks/other_outline.h"

#include <fmt/core.h>

#include "calib/pose/outline_model.h"

namespace scattermeter::apps {

std::optional<Finding> other_outline(const Rig& rig, const ObjectScenes& objects,
                                     const PoseResult& pose, const Contours& contours,
                                     std::size_t shot_idx, const calib::OutlineLook& look,
                                     const capture::FrameSource& frames) {
  constexpr double kOtherShare = 0.9;
  constexpr double kOtherGain = 0.1;
  if (contours.size() < 2) return std::nullopt;
  const SceneShot& shot = rig.scene.shots.at(shot_idx);
  const auto share_of = [&](const std::string& name, const calib::OutlineLook& of_it) {
    return calib::outline_share(of_it, contours.at(name), rig.scene.camera.intrinsics, pose,
                                objects.at(name).box.center_mm());
  };
  const double own = share_of(shot.object, look);
  double best = 0.0;
  std::string other;
  const capture::RawFrame frame = frames(shot_idx, 0);
  for (const auto& [name, contour] : contours) {
    if (name == shot.object) continue;
    const double share =
        share_of(name, calib::look_at_outline(contour, frame, noise_in_force(rig)));
    if (share <= best) continue;
    best = share;
    other = name;
  }
  if (best < kOtherShare || best < own + kOtherGain) return std::nullopt;
  return Finding{
      "file exchanged",
      fmt::format(
          "file exchanged: {} has the outline of {} ({:.0f} % of it fits), not of {} ({:.0f} %)",
          shot.file, other, 100.0 * best, shot.object, 100.0 * own),
      "give the file its right name, or correct shots.object",
      {shot_idx}};
}

}  // namespace scattermeter::apps
