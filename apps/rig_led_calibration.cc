#include "apps/rig_led_calibration.h"

#include <algorithm>
#include <set>

#include "apps/rig_fields.h"
#include "apps/rig_white_plane.h"

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

RigLedShot read_led_shot(const YamlField& field, const RigLedCalibration& calibration) {
  field.only({"file", "kind", "light", "plane", "exposure_s"});
  RigLedShot shot;
  shot.line = field.line();
  shot.file = file_in_folder(field.at("file"));
  const YamlField kind = field.at("kind");
  if (kind.text() != "spheres" && kind.text() != "plane") kind.fail("expected spheres or plane");
  shot.is_plane = kind.text() == "plane";
  shot.light = field.at("light").text();
  if (const auto f = field.find("plane")) {
    if (!shot.is_plane) f->fail("is given in a shot of the spheres");
    shot.plane = static_cast<std::size_t>(
        f->integer(1, std::max(1, static_cast<int>(calibration.planes.size()))) - 1);
  } else if (shot.is_plane && calibration.planes.size() > 1) {
    field.fail("there are several planes: say which by plane: 1, 2 ...");
  }
  if (shot.is_plane && calibration.planes.empty()) kind.fail("there are no planes in the rig");
  if (!shot.is_plane && calibration.spheres.empty()) kind.fail("there are no spheres in the rig");
  if (const auto f = field.find("exposure_s")) shot.exposure_s = f->positive();
  return shot;
}

}  // namespace

std::vector<std::string> RigLedCalibration::lights() const {
  std::vector<std::string> names;
  for (const RigLedShot& shot : shots) {
    if (std::find(names.begin(), names.end(), shot.light) == names.end()) {
      names.push_back(shot.light);
    }
  }
  return names;
}

RigLedCalibration read_led_calibration(const YamlField& field, const std::string& rig_path) {
  static_cast<void>(rig_path);  // names no files
  field.only({"spheres", "planes", "shots"});
  RigLedCalibration calibration;
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
