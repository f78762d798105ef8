#include "apps/rig/rig_calibration.h"

#include "apps/rig/rig_camera_calibration.h"
#include "apps/rig/rig_led_calibration.h"
#include "apps/rig/rig_radiance_calibration.h"
#include "apps/rig/yaml_field.h"

namespace scattermeter::apps {

RigCalibration read_calibration(const YamlField& field, const std::string& rig_path) {
  field.only({"camera", "led", "radiance"});
  RigCalibration calibration;
  if (const auto f = field.find("camera")) {
    calibration.camera = read_camera_calibration(*f, rig_path);
  }
  if (const auto f = field.find("led")) calibration.led = read_led_calibration(*f, rig_path);
  if (const auto f = field.find("radiance")) {
    calibration.radiance = read_radiance_calibration(*f, rig_path);
  }
  return calibration;
}

}  // namespace scattermeter::apps
