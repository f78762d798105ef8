#include "apps/rig/rig_led_calibration.h"

#include <algorithm>
#include <set>

#include "apps/rig/rig_fields.h"
#include "apps/rig/rig_white_plane.h"

namespace scattermeter::apps {
namespace {

calib::MirrorSphere read_sphere(const YamlField& field) {
  field.only({"center_mm", "radius_mm", "center_std_mm", "radius_std_mm"});
  calib::MirrorSphere sphere;
  sphere.center_mm = field.at("center_mm").vector3();
  sphere.radius_mm = field.at("radius_mm").positive();
  if (const auto f = field.find("center_std_mm")) sphere.center_std_mm = f->number(0.0, 1000.0);
  if (const auto f = field.find("radius_std_mm")) sphere.radius_std_mm = f->number(0.0, 1000.0);
  return sphere;
}

calib::LedShotKind shot_kind(const YamlField& field) {
  const std::string text = field.text();
  if (text == "spheres") return calib::LedShotKind::kSpheres;
  if (text == "plane") return calib::LedShotKind::kPlane;
  if (text == "ambient") return calib::LedShotKind::kAmbient;
  field.fail("expected spheres, plane or ambient");
}

calib::AmbientModel ambient_model(const YamlField& field) {
  const std::string text = field.text();
  if (text == "where_seen") return calib::AmbientModel::kWhereSeen;
  if (text == "fitted") return calib::AmbientModel::kFitted;
  if (text == "none") return calib::AmbientModel::kNone;
  field.fail("expected where_seen, fitted or none");
}

calib::LedCalibrationShot read_led_shot(const YamlField& field,
                                        const calib::LedCalibrationShots& calibration) {
  field.only({"file", "kind", "light", "plane", "exposure_s"});
  calib::LedCalibrationShot shot;
  shot.line = field.line();
  shot.file = file_in_folder(field.at("file"));
  const YamlField kind = field.at("kind");
  shot.kind = shot_kind(kind);
  const bool has_plane = shot.kind != calib::LedShotKind::kSpheres;
  if (shot.kind != calib::LedShotKind::kAmbient) {
    shot.light = field.at("light").text();
  } else if (const auto f = field.find("light")) {
    f->fail("is given in an ambient shot, where every LED is off");
  }
  if (const auto f = field.find("plane")) {
    if (!has_plane) f->fail("is given in a shot of the spheres");
    shot.plane = static_cast<std::size_t>(
        f->integer(1, std::max(1, static_cast<int>(calibration.planes.size()))) - 1);
  } else if (has_plane && calibration.planes.size() > 1) {
    field.fail("there are several planes: state which one (plane: 1, 2 ...)");
  }
  if (has_plane && calibration.planes.empty()) kind.fail("there are no planes in the rig");
  if (!has_plane && calibration.spheres.empty()) kind.fail("there are no spheres in the rig");
  if (shot.kind == calib::LedShotKind::kAmbient && calibration.ambient_shot(shot.plane)) {
    field.fail("the plane has two ambient shots");
  }
  if (const auto f = field.find("exposure_s")) shot.exposure_s = exposure_time_s(*f);
  return shot;
}

}  // namespace

calib::LedCalibrationShots read_led_calibration(const YamlField& field,
                                                const std::string& rig_path) {
  field.only({"spheres", "planes", "shots", "ambient"});
  calib::LedCalibrationShots calibration;
  calibration.path = rig_path;
  calibration.line = field.line();
  if (const auto f = field.find("spheres")) {
    for (const YamlField& sphere : f->items()) calibration.spheres.push_back(read_sphere(sphere));
  }
  if (const auto f = field.find("planes")) {
    for (const YamlField& plane : f->items()) {
      plane.only({"origin_mm", "x_axis", "y_axis", "size_mm", "albedo", "albedo_relative_std"});
      calibration.planes.push_back(read_white_plane(plane, 0.0));
    }
  }
  if (const auto f = field.find("ambient")) calibration.ambient = ambient_model(*f);
  std::set<std::string> files;
  const YamlField shots = field.at("shots");
  for (const YamlField& shot : shots.items()) {
    calibration.shots.push_back(read_led_shot(shot, calibration));
    if (!files.insert(calibration.shots.back().file).second) {
      shot.at("file").fail("two shots of the same name");
    }
  }
  if (calibration.shots.empty()) shots.fail("expected at least one shot");
  return calibration;
}

}  // namespace scattermeter::apps
