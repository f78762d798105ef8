// A rig with calibration.led, as text.
#pragma once

#include <string>

namespace scattermeter::apps {

struct LedRigText {
  // In the YAML of `lights`.
  std::string led =
      "{type: led, position_mm: [30, -60, 80], axis: [-25, 55, -80], exponent: 1.3, "
      "radius_mm: 2, intensity_W_per_sr: [0.05, 0.06, 0.04]}";
  std::string planes = R"(
      - {origin_mm: [-30, -22, 0], size_mm: [60, 44], albedo: [0.9, 0.92, 0.88], albedo_relative_std: 0.005}
      - {origin_mm: [-30, -22, 15], size_mm: [60, 44], albedo: [0.9, 0.92, 0.88], albedo_relative_std: 0.005}
)";
  std::string more;   // further lines of calibration.led, indented by four
  std::string truth;  // the whole section
  std::string shots = R"(
      - {file: spheres_led1.dng, kind: spheres, light: led1}
      - {file: low_led1.dng, kind: plane, plane: 1, light: led1}
      - {file: high_led1.dng, kind: plane, plane: 2, light: led1}
)";
};

// 484 x 324 pixels, four mirror spheres of 8 mm radius, marks that are exact.
std::string led_rig_yaml(const LedRigText& text = {});

}  // namespace scattermeter::apps
