#include "apps/instrument/rig_places.h"

#include <cmath>

namespace scattermeter::apps {
namespace {

RigPlaces::Camera camera_place(const CameraIntrinsics& k, const PoseResult& pose,
                               const std::string& name) {
  const double right = k.width_px - 0.5, bottom = k.height_px - 0.5;
  const std::vector<Eigen::Vector2d> corners_px = {
      {-0.5, -0.5}, {right, -0.5}, {right, bottom}, {-0.5, bottom}};
  const std::vector<Eigen::Vector2d> rays = undistort(k, corners_px);
  const Rigid3d world_from_camera = inverse(pose.camera_from_world);
  RigPlaces::Camera out{name, world_from_camera.translation_mm, {}, pose.center_std_mm};
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Eigen::Vector2d straight((corners_px[i].x() - k.cx_px) / k.fx_px,
                                   (corners_px[i].y() - k.cy_px) / k.fy_px);
    const Eigen::Vector2d& ray = rays[i].allFinite() ? rays[i] : straight;
    out.corners[i] = world_from_camera.rotation * ray.homogeneous().normalized();
  }
  return out;
}

}  // namespace

std::array<Eigen::Vector3d, 4> board_corners(const calib::CharucoBoard& board) {
  const double width_mm = board.squares_x * board.square_mm;
  const double height_mm = board.squares_y * board.square_mm;
  const auto at = [&](double x, double y) {
    return board.world_from_board * Eigen::Vector3d(x, y, 0);
  };
  return {at(0, 0), at(width_mm, 0), at(width_mm, height_mm), at(0, height_mm)};
}

RigPlaces rig_places(const Rig& rig, const ObjectScenes& objects,
                     const std::vector<ObservedShot>& shots) {
  RigPlaces out;
  for (const ObservedShot& shot : shots) {
    if (!shot.has_own_pose && !out.cameras.empty()) continue;
    out.cameras.push_back(camera_place(rig.scene.camera.intrinsics, shot.pose,
                                       shot.has_own_pose ? shot.stated->file : "camera"));
  }
  for (const SceneLight& light : rig.scene.lights) {
    if (const LedLight* led = light.led()) {
      const double std_mm =
          led->calibrated ? std::sqrt(led->calibrated->covariance.diagonal().head<3>().maxCoeff())
                          : led->position_std_mm;
      out.leds.push_back({light.name, led->led.position_mm, led->led.axis, std_mm});
    }
  }
  for (const auto& [name, object] : objects) out.bodies.push_back({name, object.mesh()});
  for (const PointPair& point : rig.pose.points) out.marks.push_back(point.world_mm);
  if (rig.pose.charuco) out.board = board_corners(*rig.pose.charuco);
  if (rig.scene.surroundings.plane) out.plane_z_mm = rig.scene.surroundings.plane->z_mm;
  return out;
}

}  // namespace scattermeter::apps
