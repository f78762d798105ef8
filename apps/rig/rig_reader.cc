#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "apps/rig/rig.h"
#include "apps/rig/rig_camera_reader.h"
#include "apps/rig/rig_fields.h"
#include "apps/rig/rig_led_agreement.h"
#include "apps/rig/rig_light_reader.h"
#include "apps/rig/rig_place_reader.h"
#include "apps/rig/rig_pose_reader.h"
#include "apps/rig/rig_roughness_reader.h"
#include "apps/rig/rig_sensor_truth.h"
#include "apps/rig/rig_surroundings.h"
#include "apps/rig/yaml_field.h"
#include "core/base/input_error.h"
#include "core/scene/default_uncertainty.h"

namespace scattermeter::apps {
namespace {

void read_phase(const YamlField& field, SceneObject& object) {
  const auto gamma = field.find("gamma");
  const auto share = field.find("share");
  if (gamma) {
    field.only({"g", "gamma", "gamma_std"});
  } else if (share) {
    field.only({"g", "share", "other_g", "g_std"});
  } else {
    field.only({"g", "g_std"});
  }
  const YamlField g = field.at("g");
  // By Henyey and Greenstein, gamma is 1 + g.
  const auto std = field.find(gamma ? "gamma_std" : "g_std");
  constexpr double kLeast = -0.4, kMost = 0.99;
  if (gamma) {
    const double of_hg = 1.0 + g.number(0.01, kMost);
    object.phase = PhaseFunction::with_gamma(of_hg - 1.0, gamma->number(0.61, of_hg));
  } else if (share) {
    object.phase = PhaseFunction::mixture(share->number(0.0, 1.0), g.number(-kMost, kMost),
                                          field.at("other_g").number(-kMost, kMost));
    if (object.phase.gamma() < 1.0 + kLeast) {
      field.fail("expected a gamma of at least 0.6");
    }
  } else {
    object.phase = g.number(kLeast, kMost);
  }
  object.gamma_std = std ? std->number(0.0, 2.0) : default_uncertainty::kStatedGamma;
}

SceneObject read_object(const std::string& name, const YamlField& field,
                        const std::string& rig_path) {
  field.only({"mesh", "eta", "eta_std", "position_std_mm", "scale_relative_std", "edge_std_mm",
              "phase", "patch_size_mm", "pose", "roughness"});
  SceneObject object;
  object.name = name;
  object.line = field.line();
  object.mesh_path = beside(rig_path, field.at("mesh").text());
  object.eta_int_over_ext = field.at("eta").number(1.0, 4.0);
  object.eta_std = field.number_or("eta_std", default_uncertainty::kEta, 0.0, 1.0);
  object.position_std_mm =
      field.number_or("position_std_mm", default_uncertainty::kObjectPosition_mm, 0.0, 1000.0);
  object.scale_relative_std =
      field.number_or("scale_relative_std", default_uncertainty::kMeshScale, 0.0, 1.0);
  object.edge_std_mm = field.number_or("edge_std_mm", default_uncertainty::kEdge_mm, 0.0, 1000.0);
  object.gamma_std = default_uncertainty::kGamma;
  if (const auto f = field.find("phase")) read_phase(*f, object);
  object.surface_alpha_std = default_uncertainty::kSurfaceAlpha;
  if (const auto f = field.find("roughness")) read_roughness(*f, object);
  if (const auto f = field.find("patch_size_mm")) object.patch_size_mm = f->positive();
  if (const auto f = field.find("pose")) read_place(*f, object);
  const auto stated = field.find("position_std_mm");
  if (object.to_be_found && stated) {
    stated->fail(
        "must not be given for a piece that is found by its silhouette, which determines it");
  }
  return object;
}

// Reads a single file with its time, or a bracket of several with as many times.
void read_shot_files(const YamlField& field, SceneShot& shot) {
  const YamlField file = field.at("file");
  const auto exposure = field.find("exposure_s");
  if (file.is_scalar()) {
    shot.file = file_in_folder(file);
    if (exposure) shot.exposure_s = exposure_time_s(*exposure);
    return;
  }
  for (const YamlField& item : file.items()) {
    std::string name = file_in_folder(item);
    if (name == shot.file ||
        std::find(shot.more_files.begin(), shot.more_files.end(), name) != shot.more_files.end()) {
      item.fail("the file is listed twice in one bracket");
    }
    if (shot.file.empty()) {
      shot.file = std::move(name);
    } else {
      shot.more_files.push_back(std::move(name));
    }
  }
  if (shot.file.empty()) file.fail("expected a file, or a list of the files of a bracket");
  if (!exposure) return;
  const std::size_t n = 1 + shot.more_files.size();
  if (exposure->is_scalar()) {
    exposure->fail("expected a list of " + std::to_string(n) +
                   " times, one for each file of the bracket");
  }
  exposure->numbers(n);
  const std::vector<YamlField> times = exposure->items();
  shot.exposure_s = exposure_time_s(times[0]);
  for (std::size_t i = 1; i < n; ++i) shot.more_exposures_s.push_back(exposure_time_s(times[i]));
}

template <typename Named>
std::vector<std::string> names_of(const std::vector<Named>& all) {
  std::vector<std::string> names;
  for (const Named& one : all) names.push_back(one.name);
  return names;
}

SceneShot read_shot(const YamlField& field, const Rig& rig) {
  field.only({"file", "object", "material", "lights", "exposure_s"});
  SceneShot shot;
  shot.line = field.line();
  read_shot_files(field, shot);
  const YamlField object = field.at("object");
  shot.object = object.text();
  const YamlField material = field.at("material");
  shot.material = material.text();
  require_name(object, names_of(rig.scene.objects), "no such object in objects");
  const YamlField lights = field.at("lights");
  for (const YamlField& light : lights.items()) {
    const std::string name = light.text();
    require_name(light, names_of(rig.scene.lights), "no such light in lights");
    for (const std::string& other : shot.lights) {
      if (other == name) light.fail("the light is listed twice");
    }
    shot.lights.push_back(name);
  }
  if (shot.lights.empty()) lights.fail("expected at least one light");
  return shot;
}

void read_truth(const YamlField& field, Rig& rig) {
  field.only({"materials", "pose", "sensor", "ambient_irradiance_W_per_mm2"});
  if (const auto ambient = field.find("ambient_irradiance_W_per_mm2")) {
    rig.truth.ambient_irradiance_W_per_mm2 = Eigen::Array3d(rgb_not_negative(*ambient).data());
  }
  if (const auto sensor = field.find("sensor")) rig.truth.sensor = read_sensor_truth(*sensor);
  if (const auto materials = field.find("materials")) {
    for (const auto& [name, material] : materials->entries()) {
      material.only({"sigma_s_prime_per_mm", "sigma_a_per_mm"});
      const std::array<double, 3> s = positive_rgb(material.at("sigma_s_prime_per_mm"));
      const std::array<double, 3> a = rgb_not_negative(material.at("sigma_a_per_mm"));
      std::array<Medium, 3>& media = rig.truth.materials[name];
      for (std::size_t c = 0; c < 3; ++c) media[c] = {s[c], a[c], 1.0};
    }
  }
  if (const auto pose = field.find("pose")) {
    pose->only({"position_mm", "look_at_mm", "up"});
    const calib::BoardViewpoint v = read_viewpoint(*pose);
    rig.truth.pose = CameraPlacement{v.position_mm, v.look_at_mm, v.up};
  }
}

}  // namespace

Rig read_rig(const std::string& path, bool with_radiance) {
  const YamlField top = YamlField::load(path);
  if (top.find("results") && !top.find("scattermeter_rig")) {
    throw InputError(path, "is a result of `measure`, not a rig");
  }
  top.only({"scattermeter_rig", "limits", "camera", "pose", "objects", "lights",
            "even_light_share_std", "shot_shift_std_px", "shots", "surroundings", "calibration",
            "truth"});
  require_version(top, "scattermeter_rig", "rigs");
  Rig rig;
  rig.path = path;
  rig.limits = read_limits(top);
  rig.decoding.max_megapixels = rig.limits.raw_megapixels;
  rig.scene.source = path;
  read_camera(top.at("camera"), with_radiance, rig);
  rig.pose = read_pose(top.at("pose"));
  for (const auto& [name, field] : top.at("objects").entries()) {
    rig.scene.objects.push_back(read_object(name, field, path));
    if (rig.scene.objects.back().to_be_found && rig.pose.refine_by_silhouette) {
      field.at("pose").at("from").fail(
          "the outline determines either the piece's position or, by pose.refine, the camera's");
    }
  }
  const YamlField lights = top.at("lights");
  rig.scene.even_light_share_std =
      top.number_or("even_light_share_std", default_uncertainty::kEvenLight, 0.0, 1.0);
  rig.scene.shot_shift_std_px =
      top.number_or("shot_shift_std_px", default_uncertainty::kShotShift_px, 0.0, 100.0);
  for (const auto& [name, field] : lights.entries()) {
    rig.scene.lights.push_back(read_light(name, field, path, rig.limits));
    const SceneLight& light = rig.scene.lights.back();
    const bool is_of_object =
        std::any_of(rig.scene.objects.begin(), rig.scene.objects.end(),
                    [&](const SceneObject& object) { return object.name == light.name; });
    if (is_of_object && light.led() != nullptr) {
      field.fail("is the name of an object, too: results tell the positions of both by name");
    }
  }
  require_different_leds(lights, rig.scene);
  take_responsivity_of_leds(lights, rig);
  std::map<std::string, int> line_of_file;
  const YamlField shots = top.at("shots");
  for (const YamlField& field : shots.items()) {
    rig.scene.shots.push_back(read_shot(field, rig));
    for (const std::string& file : rig.scene.shots.back().files()) {
      const auto [first, is_new] = line_of_file.emplace(file, field.line());
      if (!is_new) {
        field.at("file").fail("two shots of the same name: " + file + " is also that of line " +
                              std::to_string(first->second));
      }
    }
  }
  require_lights_of_rough_objects(rig.scene);
  separate_standings(rig.scene);
  if (rig.scene.shots.empty()) shots.fail("expected at least one shot");
  if (const auto f = top.find("surroundings")) rig.scene.surroundings = read_surroundings(*f);
  if (const auto f = top.find("calibration")) rig.calibration = read_calibration(*f, path);
  if (rig.calibration.radiance && rig.calibration.radiance->white) {
    std::vector<std::string> leds;
    for (const SceneLight& light : rig.scene.lights) {
      if (light.led() != nullptr) leds.push_back(light.name);
    }
    require_name(top.at("calibration").at("radiance").at("white").at("light"), leds,
                 "no such LED in lights");
  }
  if (const auto truth = top.find("truth")) read_truth(*truth, rig);
  return rig;
}

}  // namespace scattermeter::apps
