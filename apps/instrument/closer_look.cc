#include "apps/instrument/closer_look.h"

#include <algorithm>
#include <cmath>

#include "calib/pose/silhouette_check.h"

namespace scattermeter::apps {

namespace {

double px_per_mm(const CameraIntrinsics& intrinsics, const ObjectScene& object,
                 const PoseResult& pose) {
  return intrinsics.fx_px / (pose.camera_from_world * object.box.center_mm()).z();
}

// Of each end of a straight edge in the picture: besides the search's own error, that of the mesh's
// size.
double line_std_px(const Rig& rig, const ObjectScenes& objects, const PoseResult& pose) {
  double out = rig.pose.edge_std_px;
  for (const auto& [name, object] : objects) {
    const double size_std_px = 0.5 * object.size_mm() * object.stated->scale_relative_std *
                               px_per_mm(rig.scene.camera.intrinsics, object, pose);
    out = std::max(out, std::hypot(rig.pose.edge_std_px, size_std_px));
  }
  return out;
}

}  // namespace

double edge_cut_px(const CameraIntrinsics& intrinsics, const ObjectScene& object,
                   const PoseResult& pose) {
  constexpr double kOfCut = 0.7;
  return kOfCut * object.stated->edge_std_mm * px_per_mm(intrinsics, object, pose);
}

bool closer_look_agrees(const Rig& rig, const ObjectScenes& objects, const PoseResult& pose,
                        const capture::FrameSource& frames, const std::vector<std::size_t>& shots) {
  constexpr std::size_t kMostShots = 4;
  constexpr double kSmall_px = 0.3;
  constexpr double kSmooth_px = 0.5;
  std::vector<std::size_t> some = shots;
  some.resize(std::min(some.size(), kMostShots));
  calib::SilhouetteCheckOptions options;
  options.silhouette.line_std_px = line_std_px(rig, objects, pose);
  for (const SceneObject& object : rig.scene.objects) {
    options.explanation.scale_relative_std =
        std::max(options.explanation.scale_relative_std, object.scale_relative_std);
  }
  const calib::SilhouetteCheck check =
      calib::check_silhouettes(rig.scene, rig.pose, objects, frames, some, pose, options);
  if (check.shots_found < some.size() || check.drifts) return false;
  return check.diagnosis.agrees ||
         (check.rms_px < kSmooth_px &&
          std::all_of(check.shots.begin(), check.shots.end(), [&](const calib::SilhouetteShot& s) {
            return s.shift_px.norm() < kSmall_px;
          }));
}

}  // namespace scattermeter::apps
