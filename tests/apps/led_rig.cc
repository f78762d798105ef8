#include "tests/apps/led_rig.h"

#include <sstream>
#include <vector>

#include "apps/camera_view.h"
#include "calib/camera_model.h"

namespace scattermeter::apps {

std::string led_rig_yaml(const LedRigText& text) {
  calib::CameraIntrinsics k;
  k.width_px = 484;
  k.height_px = 324;
  k.fx_px = k.fy_px = 1229.5;
  k.cx_px = 241.8;
  k.cy_px = 161.2;
  const Rigid3d camera_from_world = look_at({0, -100, 150}, {0, 0, 5}, {0, 0, 1});
  const std::vector<Eigen::Vector3d> marks = {
      {-28, -20, 0}, {28, -20, 0}, {28, 20, 0},  {-28, 20, 0},  {0, -22, 0},
      {-28, -8, 12}, {28, -8, 12}, {24, 16, 15}, {-20, 18, 14}, {0, 20, 10}};
  std::ostringstream out;
  out.precision(12);
  out << R"(scattermeter_rig: 1
camera:
  model: NIKON D80
  image_size_px: [484, 324]
  intrinsics: {fx_px: 1229.5, fy_px: 1229.5, cx_px: 241.8, cy_px: 161.2}
  responsivity_counts_mm2_sr_per_W_s: [2.4e10, 2.9e10, 2.1e10]
  responsivity_relative_std: 0.01
  sensor: {gain_e_per_count: 6.0, read_noise_counts: 1.2, black_counts: 64}
pose:
  point_std_px: 0.05
  points:
)";
  const std::vector<Eigen::Vector2d> px = calib::project(k, camera_from_world, marks);
  for (std::size_t i = 0; i < marks.size(); ++i) {
    out << "    - {world_mm: [" << marks[i].x() << ", " << marks[i].y() << ", " << marks[i].z()
        << "], image_px: [" << px[i].x() << ", " << px[i].y() << "]}\n";
  }
  out << "objects:\n  cube: {mesh: cube.obj, eta: 1.4}\nlights:\n  led1: " << text.led << R"(
shots:
  - {file: a.dng, object: cube, material: PP, lights: [led1]}
calibration:
  led:
    spheres:
      - {center_mm: [-24, -12, 8], radius_mm: 8, center_std_mm: 0.006}
      - {center_mm: [24, -14, 8], radius_mm: 8, center_std_mm: 0.006}
      - {center_mm: [-22, 16, 10], radius_mm: 8, center_std_mm: 0.006}
      - {center_mm: [23, 15, 8], radius_mm: 8, center_std_mm: 0.006}
    planes:)"
      << text.planes << "    shots:" << text.shots << text.more << text.truth;
  return out.str();
}

}  // namespace scattermeter::apps
