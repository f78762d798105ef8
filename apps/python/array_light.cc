#include "apps/python/array_light.h"

#include <array>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <vector>

#include <pybind11/stl.h>

#include "apps/python/dict_field.h"
#include "core/scene/default_uncertainty.h"

namespace py = pybind11;

namespace scattermeter::python {
namespace {

Eigen::Vector3d vector3(const py::dict& dict, const std::string& where, const char* key) {
  return Eigen::Vector3d(field<std::array<double, 3>>(dict, where, key).data());
}

std::shared_ptr<const LobeTable> lobe_table(const py::dict& dict, const std::string& where) {
  using Values = std::vector<double>;
  Values angles_rad = field<Values>(dict, where, "angle_deg");
  for (double& a : angles_rad) a *= std::numbers::pi / 180.0;
  try {
    if (dict.contains("relative")) {
      return std::make_shared<LobeTable>(std::move(angles_rad),
                                         field<Values>(dict, where, "relative"));
    }
    return std::make_shared<LobeTable>(
        std::move(angles_rad), field<Values>(dict, where, "relative_x"),
        field<Values>(dict, where, "relative_y"), vector3(dict, where, "x_axis"));
  } catch (const std::invalid_argument& e) {
    throw InputError(where, e.what());
  }
}

}  // namespace

SceneLight scene_light(const std::string& name, const py::dict& dict) {
  const std::string where = "lights." + name;
  SceneLight light;
  light.name = name;
  LedLight& led = light.kind.emplace<LedLight>();
  led.led.position_mm = vector3(dict, where, "position_mm");
  led.led.axis = vector3(dict, where, "axis").normalized();
  if (dict.contains("lobe")) {
    led.led.table = lobe_table(field<py::dict>(dict, where, "lobe"), where + ".lobe");
    if (!led.led.table->has_planes_about(led.led.axis)) {
      throw InputError(where + ".lobe.x_axis", "expected a direction across the LED's axis");
    }
  }
  led.led.exponent = field<double>(dict, where, "exponent", led.led.table ? 0.0 : 1.0);
  led.led.radius_mm = field<double>(dict, where, "radius_mm", 0.0);
  led.led.intensity_W_per_sr = vector3(dict, where, "intensity_W_per_sr").array();
  led.position_std_mm =
      deviation(dict, where, "position_std_mm", default_uncertainty::kLedPosition_mm);
  led.axis_std_rad = deviation(dict, where, "axis_std_deg", default_uncertainty::kLedAxis_deg) *
                     std::numbers::pi / 180.0;
  led.exponent_std = deviation(dict, where, "exponent_std", default_uncertainty::kLedExponent);
  led.intensity_relative_std =
      deviation(dict, where, "intensity_relative_std", default_uncertainty::kLedIntensity);
  return light;
}

}  // namespace scattermeter::python
