#include "apps/looks/closer_look.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

namespace scattermeter::apps {
namespace {

// Of each corner in the picture: besides the search's own error, that of the mesh's size.
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

calib::SilhouetteCheck careful_search(const Rig& rig, const ObjectScenes& objects,
                                      const PoseResult& pose, const capture::FrameSource& frames,
                                      std::vector<std::size_t> shots, double line_std_px) {
  constexpr std::size_t kMostShots = 4;
  shots.resize(std::min(shots.size(), kMostShots));
  calib::SilhouetteCheckOptions options;
  options.silhouette.line_std_px = line_std_px;
  options.explanation.scale_relative_std = mesh_scale_std(rig.scene);
  return calib::check_silhouettes(rig.scene, rig.pose, objects, frames, shots, pose, options);
}

double mesh_scale_std(const Scene& scene) {
  double out = 0.0;
  for (const SceneObject& object : scene.objects) out = std::max(out, object.scale_relative_std);
  return out;
}

double px_per_mm(const CameraIntrinsics& intrinsics, const ObjectScene& object,
                 const PoseResult& pose) {
  return intrinsics.fx_px / (pose.camera_from_world * object.box.center_mm()).z();
}

double edge_cut_px(const CameraIntrinsics& intrinsics, const ObjectScene& object,
                   const PoseResult& pose) {
  constexpr double kOfCut = 0.7;
  return kOfCut * object.stated->edge_std_mm * px_per_mm(intrinsics, object, pose);
}

double quick_place_std_mm(const ObjectScene& object) {
  constexpr double kLeast_mm = 0.1;
  return std::max(kLeast_mm, object.stated->position_std_mm);
}

calib::OutlineOptions outline_options(const Rig& rig, const ObjectScenes& objects,
                                      const PoseResult& pose) {
  calib::OutlineOptions out;
  out.scale_relative_std = mesh_scale_std(rig.scene);
  for (const auto& [name, object] : objects) {
    const double std_mm = quick_place_std_mm(object);
    out.place_std_mm = std::max(out.place_std_mm, std_mm);
    // Its orientation is as uncertain at a distance of its own size.
    out.turn_std_rad = std::max(out.turn_std_rad, std_mm / object.size_mm());
    out.growth_std_px =
        std::max(out.growth_std_px, edge_cut_px(rig.scene.camera.intrinsics, object, pose));
  }
  return out;
}

std::string shift_phrase(const Eigen::Vector2d& shift_px) {
  return fmt::format("{:.1f} px {} and {:.1f} px {}", std::abs(shift_px.x()),
                     shift_px.x() < 0 ? "left" : "right", std::abs(shift_px.y()),
                     shift_px.y() < 0 ? "high" : "low");
}

bool closer_look_agrees(const Rig& rig, const ObjectScenes& objects, const PoseResult& pose,
                        const capture::FrameSource& frames, const std::vector<std::size_t>& shots) {
  constexpr double kSmall_px = 0.3;
  constexpr double kSmooth_px = 0.5;
  const calib::SilhouetteCheck check =
      careful_search(rig, objects, pose, frames, shots, line_std_px(rig, objects, pose));
  if (check.shots_found < check.shots.size() || check.drifts) return false;
  return check.diagnosis.agrees ||
         (check.rms_px < kSmooth_px &&
          std::all_of(check.shots.begin(), check.shots.end(), [&](const calib::SilhouetteShot& s) {
            return s.shift_px.norm() < kSmall_px;
          }));
}

std::string outline_departure(const Rig& rig, const ObjectScenes& objects, const PoseResult& pose,
                              const capture::FrameSource& frames,
                              const std::vector<std::size_t>& shots) {
  constexpr double kSmall_px = 1.0;
  constexpr double kStds = 1.5;
  constexpr double kOfShift = 0.5;
  // An error of the mesh's size shifts no outline as a whole.
  const calib::SilhouetteCheck check =
      careful_search(rig, objects, pose, frames, shots, rig.pose.edge_std_px);
  if (check.shots.empty() || check.shots_found < check.shots.size()) return "";
  Eigen::Vector2d shift_px = Eigen::Vector2d::Zero();
  double std_px = 0.0;  // the shots have much of it in common
  for (const calib::SilhouetteShot& s : check.shots) {
    shift_px += s.shift_px / static_cast<double>(check.shots.size());
    std_px = std::max(std_px, s.shift_std_px.maxCoeff());
  }
  if (shift_px.norm() < std::max(kSmall_px, kStds * std_px)) return "";
  // A shift moves some edge by most of itself; what would be less is another shape.
  if (check.worst_px < kOfShift * shift_px.norm()) {
    return fmt::format(
        "shape or lens: the outlines depart by up to {:.1f} px from those of the mesh, which no "
        "shift explains; measure the object along all its edges, and calibrate the lens",
        check.worst_px);
  }
  return fmt::format(
      "pose or position: the outlines stand {} (± {:.1f} px) of where pose and mesh put them; take "
      "the pose points again, or place the mesh where the object stands",
      shift_phrase(shift_px), std::max(0.1, std_px));
}

}  // namespace scattermeter::apps
