#include "apps/rig_light_reader.h"

#include <limits>

#include <Eigen/Geometry>

#include "apps/led_calibration_file.h"
#include "apps/rig_fields.h"
#include "core/environment.h"

namespace scattermeter::apps {
namespace {

// Three numbers of at least 0, one of them above.
Eigen::Array3d some_light(const YamlField& field) {
  const std::array<double, 3> rgb = rgb_not_negative(field);
  if (!(rgb[0] + rgb[1] + rgb[2] > 0.0)) field.fail("expected light in at least one channel");
  return {rgb[0], rgb[1], rgb[2]};
}

void read_led(const YamlField& field, const std::string& rig_path, RigLight& light) {
  field.only({"type", "calibration", "position_mm", "axis", "exponent", "radius_mm",
              "intensity_W_per_sr", "position_std_mm", "exponent_std", "intensity_relative_std"});
  if (const auto calibration = field.find("calibration")) {
    for (const auto& [key, value] : field.entries()) {
      if (key == "type" || key == "calibration") continue;
      value.fail("is given twice: here and by the calibration");
    }
    light.calibration_path = beside(rig_path, calibration->text());
    const CalibratedLed calibrated = read_led_calibration_file(light.calibration_path);
    light.led = calibrated.led;
    light.calibrated = calibrated.uncertainty;
    // Spheres alone leave the power as the rig had it.
    const bool has_power =
        (calibrated.uncertainty.covariance.diagonal().tail<3>().array() > 0.0).any();
    if (has_power) light.calibrated_for = calibrated.responsivity;
    return;
  }
  light.led.position_mm = field.at("position_mm").vector3();
  light.led.axis = unit_vector(field.at("axis"));
  if (const auto f = field.find("exponent")) light.led.exponent = f->number(0.0, 1000.0);
  if (const auto f = field.find("radius_mm")) light.led.radius_mm = f->number(0.0, 1000.0);
  light.led.intensity_W_per_sr = some_light(field.at("intensity_W_per_sr"));
  if (const auto f = field.find("position_std_mm")) {
    light.position_std_mm = f->number(0.0, 1000.0);
  }
  if (const auto f = field.find("exponent_std")) light.exponent_std = f->number(0.0, 1000.0);
  if (const auto f = field.find("intensity_relative_std")) {
    light.power_relative_std = f->number(0.0, 10.0);
  }
}

RigEnvironment read_environment(const YamlField& field, const std::string& rig_path,
                                RigLight& light) {
  field.only({"type", "image", "projection", "forward", "up", "radiance_W_per_mm2_sr",
              "radiance_relative_std"});
  RigEnvironment environment;
  environment.image_path = beside(rig_path, field.at("image").text());
  const YamlField projection = field.at("projection");
  const std::string name = projection.text();
  if (name == "equirectangular") {
    environment.projection = ProbeProjection::kEquirectangular;
  } else if (name == "angular_map") {
    environment.projection = ProbeProjection::kAngularMap;
  } else if (name == "mirror_ball") {
    environment.projection = ProbeProjection::kMirrorBall;
  } else {
    projection.fail("expected equirectangular, angular_map or mirror_ball");
  }
  Eigen::Vector3d forward = Eigen::Vector3d::UnitY();
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  if (const auto f = field.find("forward")) forward = unit_vector(*f);
  if (const auto f = field.find("up")) up = unit_vector(*f);
  if (!(forward.cross(up).norm() > 1e-6)) field.fail("forward and up are parallel");
  environment.world_from_probe = world_from_probe(forward, up);
  if (const auto f = field.find("radiance_W_per_mm2_sr")) {
    environment.radiance_W_per_mm2_sr = some_light(*f);
  }
  if (const auto f = field.find("radiance_relative_std")) {
    light.power_relative_std = f->number(0.0, 10.0);
  }
  return environment;
}

// Even light from all sides whose radiance is known to a standard deviation, or not at all.
RigEnvironment read_ambient(const YamlField& field, RigLight& light) {
  field.only({"type", "radiance_W_per_mm2_sr", "radiance_std_W_per_mm2_sr"});
  RigEnvironment environment;
  environment.radiance_W_per_mm2_sr.setZero();
  if (const auto f = field.find("radiance_W_per_mm2_sr")) {
    const std::array<double, 3> rgb = rgb_not_negative(*f);
    environment.radiance_W_per_mm2_sr = {rgb[0], rgb[1], rgb[2]};
  }
  const YamlField std = field.at("radiance_std_W_per_mm2_sr");
  if (std.is_scalar()) {
    if (std.text() != "free") std.fail("expected three numbers (R, G, B) or free");
    light.ambient_std_W_per_mm2_sr.setConstant(std::numeric_limits<double>::infinity());
  } else {
    const std::array<double, 3> rgb = rgb_not_negative(std);
    light.ambient_std_W_per_mm2_sr = {rgb[0], rgb[1], rgb[2]};
  }
  return environment;
}

}  // namespace

RigLight read_light(const std::string& name, const YamlField& field, const std::string& rig_path) {
  RigLight light;
  light.name = name;
  light.line = field.line();
  const YamlField type = field.at("type");
  if (type.text() == "environment") {
    light.environment = read_environment(field, rig_path, light);
  } else if (type.text() == "led") {
    read_led(field, rig_path, light);
  } else if (type.text() == "ambient") {
    light.is_ambient = true;
    light.environment = read_ambient(field, light);
  } else {
    type.fail("expected led, environment or ambient");
  }
  return light;
}

}  // namespace scattermeter::apps
