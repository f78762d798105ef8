// Synthetic shots of an LED, as the calibration sees them, with every error drawn.
#pragma once

#include <cstdint>

#include "calib/led_scene.h"
#include "core/led.h"

namespace scattermeter::calib {

// An LED 104 mm from the origin, exponent 1.3, pointing past it.
Led true_led();

// A camera of 968 x 648 pixels at (0, -100, 150) mm that looks at the origin.
CameraIntrinsics led_camera();
Rigid3d led_camera_pose();

struct LedSceneOptions {
  bool spheres = true;
  int planes = 1;         // 60 x 45 mm, at z = 0, 15 ...
  double plane_z_mm = 0;  // of the first one
  double plane_size = 1;  // scales it
  double rotation_std_rad = 2e-4;
  double translation_std_mm = 0.003;
  double center_std_mm = 0.002;  // of each sphere
  double albedo_std = 0.005;
  double highlight_std_px = 0.03;
  double cell_relative_std = 5e-4;
  Eigen::Array3d ambient_irradiance_W_per_mm2 = Eigen::Array3d::Zero();
};

// What a camera that stands a little off where it is believed to stand, spheres that do and a plane
// that is a little whiter show, under the LED and a constant ambient irradiance. The scene holds
// what is believed, with the right standard deviations. Cells are means of 5 x 5 points.
LedScene draw_led_scene(const Led& truth, const LedSceneOptions& options, std::uint64_t seed);

}  // namespace scattermeter::calib
