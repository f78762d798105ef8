#include "calib/led/led_frame.h"

#include <cmath>

#include "core/base/covariance_root.h"
#include "core/base/tangents.h"

namespace scattermeter::calib {

LedFrame::LedFrame(const LedScene& led_scene, const Led& center)
    : scene(led_scene), lens(led_scene.intrinsics), led(center) {
  tangents = scattermeter::tangents(led.axis);
  for (const LedView& v : scene.views) pose_root.push_back(covariance_root(v.pose_covariance));
  ambient_unit.assign(scene.plane_shots(), Eigen::Array3d::Zero());
  std::vector<Eigen::Array3d> n(ambient_unit);
  for (const ShadedCell& cell : scene.cells) {
    ambient_unit[cell.shot][cell.channel] += cell.radiance_W_per_mm2_sr;
    n[cell.shot][cell.channel] += 1.0;
  }
  for (std::size_t i = 0; i < n.size(); ++i) {
    ambient_unit[i] = (ambient_unit[i] / n[i].max(1.0)).max(1e-300);
  }
}

Led LedFrame::at(const double* x) const {
  Led out = led;
  out.position_mm = Eigen::Vector3d(x[0], x[1], x[2]);
  out.axis = (led.axis + x[3] * tangents[0] + x[4] * tangents[1]).normalized();
  out.exponent = x[5];
  for (int c = 0; c < 3; ++c) {
    out.intensity_W_per_sr[c] = led.intensity_W_per_sr[c] > 0.0 ? std::exp(x[6 + c]) : 0.0;
  }
  return out;
}

std::array<double, kLedParameters> LedFrame::start() const {
  std::array<double, kLedParameters> x{};
  for (std::size_t i = 0; i < 3; ++i) x[i] = led.position_mm[static_cast<Eigen::Index>(i)];
  x[5] = led.exponent;
  for (std::size_t c = 0; c < 3; ++c) {
    const double intensity = led.intensity_W_per_sr[static_cast<Eigen::Index>(c)];
    x[6 + c] = intensity > 0.0 ? std::log(intensity) : 0.0;
  }
  return x;
}

}  // namespace scattermeter::calib
