#include "apps/rig/rig_light_reader.h"

#include <array>
#include <iterator>
#include <limits>
#include <numbers>
#include <utility>

#include <Eigen/Geometry>

#include "apps/rig/led_calibration_file.h"
#include "apps/rig/rig_fields.h"
#include "apps/rig/rig_led_lobe.h"
#include "apps/rig/yaml_field.h"
#include "capture/files/probe_reader.h"
#include "core/base/input_error.h"
#include "core/base/nearest_name.h"
#include "core/light/environment.h"
#include "core/scene/default_uncertainty.h"

namespace scattermeter::apps {
namespace {

// What the reader of each kind receives.
struct LightEntry {
  const YamlField& field;
  const std::string& rig_path;
  const RigLimits& limits;
  std::string where;  // "rig.yaml:12: lights.hall"
};

void read_led(const LightEntry& entry, SceneLight& light) {
  const YamlField& field = entry.field;
  LedLight& led_light = light.kind.emplace<LedLight>();
  Led& led = led_light.led;
  field.only({"type", "calibration", "position_mm", "axis", "exponent", "lobe", "radius_mm",
              "intensity_W_per_sr", "position_std_mm", "axis_std_deg", "exponent_std",
              "intensity_relative_std"});
  if (const auto calibration = field.find("calibration")) {
    for (const auto& [key, value] : field.entries()) {
      if (key == "type" || key == "calibration") continue;
      value.fail("is given twice: here and in the calibration");
    }
    light.files.push_back(file_beside(entry.rig_path, *calibration));
    const CalibratedLed calibrated = read_led_calibration_file(light.files.back());
    led = calibrated.led;
    led_light.calibrated = calibrated.uncertainty;
    led_light.calibrated_for = calibrated.responsivity;
    led_light.radiance_corrected = calibrated.radiance_corrected;
    return;
  }
  led.position_mm = field.at("position_mm").vector3();
  led.axis = unit_vector(field.at("axis"));
  if (const auto f = field.find("exponent")) led.exponent = f->number(0.0, 1000.0);
  if (const auto f = field.find("lobe")) {
    if (const auto given = field.find("exponent")) {
      given->fail("is given twice: here and by the table lobe");
    }
    led.table = read_lobe(*f, led.axis);
    led.exponent = 0.0;
  }
  if (const auto f = field.find("radius_mm")) led.radius_mm = f->number(0.0, 1000.0);
  led.intensity_W_per_sr = some_light(field.at("intensity_W_per_sr"));
  led_light.position_std_mm =
      field.number_or("position_std_mm", default_uncertainty::kLedPosition_mm, 0.0, 1000.0);
  led_light.axis_std_rad =
      field.number_or("axis_std_deg", default_uncertainty::kLedAxis_deg, 0.0, 180.0) *
      std::numbers::pi / 180.0;
  led_light.exponent_std =
      field.number_or("exponent_std", default_uncertainty::kLedExponent, 0.0, 1000.0);
  led_light.intensity_relative_std =
      field.number_or("intensity_relative_std", default_uncertainty::kLedIntensity, 0.0, 10.0);
  // An LED in the very origin of the world may be, but not one a millimetre beside it.
  require_mm(field.at("position_mm"), led.position_mm.norm(), 2.0);
}

ProbeProjection read_projection(const YamlField& field) {
  const std::string name = field.text();
  if (name == "equirectangular") return ProbeProjection::kEquirectangular;
  if (name == "angular_map") return ProbeProjection::kAngularMap;
  if (name == "mirror_ball") return ProbeProjection::kMirrorBall;
  field.fail("expected equirectangular, angular_map or mirror_ball");
}

void read_environment(const LightEntry& entry, SceneLight& light) {
  const YamlField& field = entry.field;
  field.only({"type", "image", "projection", "forward", "up", "radiance_W_per_mm2_sr",
              "radiance_relative_std"});
  light.files.push_back(beside(entry.rig_path, field.at("image").text()));
  const ProbeProjection projection = read_projection(field.at("projection"));
  Eigen::Vector3d forward = Eigen::Vector3d::UnitY();
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  if (const auto f = field.find("forward")) forward = unit_vector(*f);
  if (const auto f = field.find("up")) up = unit_vector(*f);
  if (!(forward.cross(up).norm() > 1e-6)) field.fail("forward and up are parallel");
  const auto read = [file = light.files.back(), projection,
                     rotation = world_from_probe(forward, up), where = entry.where + ".image",
                     pixels = static_cast<std::size_t>(1e6 * entry.limits.probe_megapixels)] {
    try {
      capture::ProbeImage image = capture::read_probe(file, {pixels});
      return Environment{image.width_px, image.height_px, std::move(image.radiance), projection,
                         rotation};
    } catch (const InputError& e) {
      rethrow_at(where, e);
    }
  };
  DistantLight& distant = light.kind.emplace<DistantLight>(read);
  if (const auto f = field.find("radiance_W_per_mm2_sr")) {
    distant.radiance_W_per_mm2_sr = some_light(*f);
  }
  if (const auto f = field.find("radiance_relative_std")) {
    distant.radiance_relative_std = f->number(0.0, 10.0);
  }
}

// Uniform light from all sides; the standard deviation of its radiance may be infinite.
void read_ambient(const LightEntry& entry, SceneLight& light) {
  const YamlField& field = entry.field;
  AmbientLight& ambient = light.kind.emplace<AmbientLight>();
  field.only({"type", "radiance_W_per_mm2_sr", "radiance_std_W_per_mm2_sr"});
  if (const auto f = field.find("radiance_W_per_mm2_sr")) {
    ambient.radiance_W_per_mm2_sr = Eigen::Array3d(rgb_not_negative(*f).data());
  }
  const YamlField std = field.at("radiance_std_W_per_mm2_sr");
  if (std.is_scalar()) {
    if (std.text() != "free") std.fail("expected three numbers (R, G, B) or free");
    ambient.radiance_std_W_per_mm2_sr.setConstant(std::numeric_limits<double>::infinity());
  } else {
    ambient.radiance_std_W_per_mm2_sr = Eigen::Array3d(rgb_not_negative(std).data());
  }
}

// The kinds of light that a rig may have, by `type`.
struct LightReader {
  const char* type;
  void (*read)(const LightEntry&, SceneLight&);
};
constexpr LightReader kLightReaders[] = {
    {"led", read_led}, {"environment", read_environment}, {"ambient", read_ambient}};

}  // namespace

SceneLight read_light(const std::string& name, const YamlField& field, const std::string& rig_path,
                      const RigLimits& limits) {
  SceneLight light;
  light.name = name;
  light.line = field.line();
  const YamlField type = field.at("type");
  const std::string text = type.text();
  const LightEntry entry{field, rig_path, limits,
                         rig_path + ":" + std::to_string(light.line) + ": lights." + name};
  std::string known;
  std::vector<std::string> names;
  for (const LightReader& reader : kLightReaders) {
    if (text == reader.type) {
      reader.read(entry, light);
      return light;
    }
    names.emplace_back(reader.type);
    const bool is_last = &reader == std::end(kLightReaders) - 1;
    known += (known.empty() ? "" : is_last ? " or " : ", ") + std::string(reader.type);
  }
  type.fail("expected " + known, did_you_mean(text, names));
}

}  // namespace scattermeter::apps
