#include "apps/simulation/synthetic_camera.h"

#include <stdexcept>
#include <vector>

#include "core/camera/camera_model.h"
#include "core/view/camera_view.h"

namespace scattermeter::apps {

void set_up_camera(Rig& rig, int image_width_px) {
  if (image_width_px < 240 || image_width_px > 3872) {
    throw std::invalid_argument("set_up_camera: a width of 240 .. 3872 px expected, got " +
                                std::to_string(image_width_px));
  }
  SceneCamera& camera = rig.scene.camera;
  const double shrink = image_width_px / 3872.0;
  camera.model = "NIKON D80";
  camera.intrinsics.width_px = image_width_px / 2 * 2;
  camera.intrinsics.height_px = image_width_px * 81 / 121 / 2 * 2;
  // A 60 mm macro lens on a sensor of 6.1 um pitch.
  camera.intrinsics.fx_px = camera.intrinsics.fy_px = 9836.0 * shrink;
  camera.intrinsics.cx_px = 1941.3 * shrink;
  camera.intrinsics.cy_px = 1290.7 * shrink;
  camera.intrinsics.distortion = {-0.03, 0.05, 0.0002, -0.0001, 0};
  camera.responsivity = {2.4e10, 2.9e10, 2.1e10};
  camera.responsivity_relative_std = 0.0;
  camera.sensor.noise = {6.0, 1.2};
  camera.f_number = 11.0;

  rig.truth.pose = CameraPlacement{{0, -100, 150}, {0, 0, 9}};
  const std::vector<Eigen::Vector3d> marks_mm = {
      {-26, -14, 0}, {26, -14, 0},  {26, 20, 0},   {-26, 20, 0}, {-26, 3, 0},
      {26, 3, 0},    {0, -16, 0},   {-12, -16, 0}, {14, -15, 0}, {-28, -8, 12},
      {28, -8, 12},  {-24, 16, 15}, {24, 16, 15},  {0, 19, 0}};
  const std::vector<Eigen::Vector2d> marks_px =
      project(camera.intrinsics,
              look_at(rig.truth.pose->position_mm, rig.truth.pose->look_at_mm, rig.truth.pose->up),
              marks_mm);
  for (std::size_t i = 0; i < marks_mm.size(); ++i) {
    rig.pose.points.push_back({marks_mm[i], marks_px[i]});
  }
  rig.pose.options.point_std_px = 0.001;
}

double pixel_mm(const Rig& rig) {
  return rig.truth.pose->position_mm.norm() / rig.scene.camera.intrinsics.fx_px;
}

SceneLight synthetic_led(const std::string& name, const Eigen::Vector3d& position_mm,
                         const Eigen::Vector3d& towards) {
  SceneLight light;
  light.name = name;
  light.led()->led.position_mm = position_mm;
  light.led()->led.axis = towards.normalized();
  light.led()->led.exponent = 1.0;
  light.led()->led.intensity_W_per_sr = {0.050, 0.052, 0.047};
  return light;
}

}  // namespace scattermeter::apps
