#include <algorithm>
#include <cmath>
#include <set>

#include "apps/rig/radiance_file.h"
#include "apps/rig/rig.h"
#include "apps/rig/rig_fields.h"
#include "apps/rig/rig_light_reader.h"
#include "apps/rig/rig_sensor_truth.h"
#include "apps/rig/yaml_field.h"
#include "calib/lens/camera_calibration_file.h"
#include "calib/lens/intrinsics_file.h"
#include "core/base/input_error.h"

namespace scattermeter::apps {
namespace {

CameraIntrinsics read_intrinsics_field(const YamlField& field, const std::string& rig_path) {
  if (field.is_scalar()) return calib::read_intrinsics(beside(rig_path, field.text()));
  field.only({"fx_px", "fy_px", "cx_px", "cy_px", "distortion"});
  CameraIntrinsics k;
  k.fx_px = field.at("fx_px").positive();
  k.fy_px = field.at("fy_px").positive();
  k.cx_px = field.at("cx_px").number();
  k.cy_px = field.at("cy_px").number();
  if (const auto distortion = field.find("distortion")) {
    for (const YamlField& term : distortion->items()) k.distortion.push_back(term.number());
    const std::size_t n = k.distortion.size();
    if (n != 0 && n != 4 && n != 5 && n != 8) {
      distortion->fail("expected 0, 4, 5 or 8 terms k1, k2, p1, p2, k3 ...");
    }
  }
  return k;
}

SceneSensor read_sensor(const YamlField& field) {
  field.only({"gain_e_per_count", "read_noise_counts", "cfa", "black_counts", "white_counts",
              "tone_curve"});
  SceneSensor s;
  if (const auto f = field.find("gain_e_per_count")) s.noise.gain_e_per_count = f->positive();
  if (const auto f = field.find("read_noise_counts")) {
    s.noise.read_noise_counts = f->number(0.0, 4095.0);
  }
  if (const auto f = field.find("cfa")) {
    try {
      s.cfa = cfa_pattern_from_name(f->text());
    } catch (const std::invalid_argument&) {
      f->fail("expected RGGB, GRBG, GBRG or BGGR");
    }
  }
  if (const auto f = field.find("white_counts")) s.white_counts = f->integer(1, 4095);
  if (const auto f = field.find("black_counts")) {
    if (f->is_scalar()) {
      s.black_counts.fill(f->integer(0, 4094));
    } else {
      f->numbers(4);
      for (std::size_t i = 0; i < 4; ++i) s.black_counts[i] = f->items()[i].integer(0, 4094);
    }
    for (int black : s.black_counts) {
      if (black >= s.white_counts) f->fail("expected black below white_counts");
    }
  }
  if (const auto f = field.find("tone_curve")) {
    const std::string name = f->text();
    if (name != "linear" && name != "nef_lossy") f->fail("expected linear or nef_lossy");
    s.nef_lossy_curve = name == "nef_lossy";
  }
  return s;
}

void read_camera(const YamlField& field, bool with_radiance, Rig& rig) {
  field.only({"model", "image_size_px", "intrinsics", "responsivity_counts_mm2_sr_per_W_s",
              "responsivity_relative_std", "radiance", "sensor", "exposure_s", "iso", "f_number"});
  SceneCamera& camera = rig.scene.camera;
  if (const auto f = field.find("model")) camera.model = f->text();
  const YamlField size = field.at("image_size_px");
  size.numbers(2);
  const YamlField intrinsics = field.at("intrinsics");
  camera.intrinsics = read_intrinsics_field(intrinsics, rig.path);
  if (intrinsics.is_scalar()) {
    rig.intrinsics_path = beside(rig.path, intrinsics.text());
    rig.lens = std::make_shared<const calib::CameraCalibrationFile>(
        calib::read_camera_calibration_file(rig.intrinsics_path));
    camera.lens_root = lens_root(rig.lens->parameters, rig.lens->covariance);
  }
  camera.intrinsics.width_px = size.items()[0].integer(2, 100'000);
  camera.intrinsics.height_px = size.items()[1].integer(2, 100'000);
  if (const std::string problem = intrinsics_problem(camera.intrinsics); !problem.empty()) {
    intrinsics.fail(problem);
  }
  if (const auto f = field.find("responsivity_counts_mm2_sr_per_W_s")) {
    camera.responsivity = positive_rgb(*f);
  }
  if (const auto f = field.find("responsivity_relative_std")) {
    if (!camera.responsivity) f->fail("is given without responsivity_counts_mm2_sr_per_W_s");
    camera.responsivity_relative_std = f->number(0.0, 10.0);
  }
  if (const auto f = field.find("radiance"); f && with_radiance) {
    const std::string file = beside(rig.path, f->text());
    auto radiance = std::make_shared<const capture::RadianceCalibration>(read_radiance_file(file));
    const capture::RadianceCorrection& c = radiance->correction;
    if (c.width_px != camera.intrinsics.width_px || c.height_px != camera.intrinsics.height_px) {
      f->fail("the calibration is of " + std::to_string(c.width_px) + " x " +
              std::to_string(c.height_px) + " samples, not of camera.image_size_px");
    }
    if (radiance->responsivity) {
      if (camera.responsivity) {
        f->fail("holds a responsivity, and camera.responsivity_counts_mm2_sr_per_W_s another");
      }
      camera.responsivity = radiance->responsivity;
      camera.responsivity_relative_std = radiance->responsivity_relative_std;
    }
    use_radiance(rig, std::move(radiance), file);
  }
  if (const auto f = field.find("sensor")) camera.sensor = read_sensor(*f);
  if (const auto f = field.find("exposure_s")) camera.exposure_s = f->positive();
  if (const auto f = field.find("iso")) camera.iso = f->integer(1, 65535);
  if (const auto f = field.find("f_number")) camera.f_number = f->positive();
}

calib::CharucoBoard read_board(const YamlField& field) {
  field.only({"squares", "square_mm", "marker_mm", "dictionary", "origin_mm", "x_axis", "y_axis"});
  calib::CharucoBoard board;
  const YamlField squares = field.at("squares");
  squares.numbers(2);
  board.squares_x = squares.items()[0].integer(2, 1000);
  board.squares_y = squares.items()[1].integer(2, 1000);
  board.square_mm = field.at("square_mm").positive();
  board.marker_mm = field.at("marker_mm").positive();
  if (const auto f = field.find("dictionary")) board.dictionary = f->text();
  Eigen::Vector3d x = Eigen::Vector3d::UnitX();
  Eigen::Vector3d y = Eigen::Vector3d::UnitY();
  if (const auto f = field.find("x_axis")) x = unit_vector(*f);
  if (const auto f = field.find("y_axis")) {
    y = unit_vector(*f);
    if (std::abs(x.dot(y)) > 1e-6) f->fail("expected a direction at right angles to x_axis");
  }
  Eigen::Matrix3d rotation;
  rotation << x, y, x.cross(y);
  if (std::abs(x.dot(y)) > 1e-6) field.fail("x_axis and y_axis are not at right angles");
  board.world_from_board.rotation = Eigen::Quaterniond(rotation).normalized();
  if (const auto f = field.find("origin_mm")) board.world_from_board.translation_mm = f->vector3();
  if (const std::string problem = calib::board_problem(board); !problem.empty()) {
    field.fail(problem);
  }
  return board;
}

calib::PoseSource read_pose(const YamlField& field) {
  field.only({"points", "charuco", "shot", "inlier_px", "point_std_px", "refine", "edge_std_px",
              "per_shot"});
  calib::PoseSource pose;
  pose.line = field.line();
  const auto points = field.find("points");
  const auto charuco = field.find("charuco");
  if (points.has_value() == charuco.has_value()) field.fail("expected either points or charuco");
  if (points) {
    pose.line = points->line();
    for (const YamlField& pair : points->items()) {
      pair.only({"world_mm", "image_px"});
      const std::vector<double> px = pair.at("image_px").numbers(2);
      pose.points.push_back({pair.at("world_mm").vector3(), {px[0], px[1]}});
    }
  } else {
    pose.line = charuco->line();
    pose.charuco = read_board(*charuco);
    pose.options.point_std_px = 0.15;  // corners of a board scatter by 0.06 to 0.14 px
  }
  if (const auto f = field.find("inlier_px")) pose.options.inlier_px = f->positive();
  if (const auto f = field.find("point_std_px")) pose.options.point_std_px = f->positive();
  if (const auto f = field.find("refine")) {
    if (f->text() != "silhouette") f->fail("expected silhouette");
    pose.refine_by_silhouette = true;
  }
  if (const auto f = field.find("edge_std_px")) {
    if (!pose.refine_by_silhouette) f->fail("only with refine: silhouette");
    pose.edge_std_px = f->positive();
  }
  if (const auto f = field.find("shot")) {
    if (!charuco) f->fail("is the shot of a board: only with charuco");
    pose.board_shot = file_in_folder(*f);
  }
  const bool in_each = charuco && pose.board_shot.empty();
  pose.per_shot = in_each;
  if (const auto f = field.find("per_shot")) {
    const std::string text = f->text();
    if (text != "true" && text != "false") f->fail("expected true or false");
    pose.per_shot = text == "true";
    if (in_each && !pose.per_shot) f->fail("with a board every shot has a pose of its own");
    if (!in_each && pose.per_shot && !pose.refine_by_silhouette) {
      f->fail("there is one pose for all shots; per_shot needs refine: silhouette");
    }
  }
  return pose;
}

SceneObject read_object(const std::string& name, const YamlField& field,
                        const std::string& rig_path) {
  field.only({"mesh", "eta", "eta_std", "patch_size_mm"});
  SceneObject object;
  object.name = name;
  object.line = field.line();
  object.mesh_path = beside(rig_path, field.at("mesh").text());
  object.eta_int_over_ext = field.at("eta").number(1.0, 4.0);
  if (const auto f = field.find("eta_std")) object.eta_std = f->number(0.0, 1.0);
  if (const auto f = field.find("patch_size_mm")) object.patch_size_mm = f->positive();
  return object;
}

// One file, or a bracket of several, with as many times.
void read_shot_files(const YamlField& field, SceneShot& shot) {
  const YamlField file = field.at("file");
  const auto exposure = field.find("exposure_s");
  if (file.is_scalar()) {
    shot.file = file_in_folder(file);
    if (exposure) shot.exposure_s = exposure->positive();
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
  shot.exposure_s = times[0].positive();
  for (std::size_t i = 1; i < n; ++i) shot.more_exposures_s.push_back(times[i].positive());
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
  const auto known = [](const auto& all, const std::string& name) {
    for (const auto& one : all) {
      if (one.name == name) return true;
    }
    return false;
  };
  if (!known(rig.scene.objects, shot.object)) object.fail("no such object in objects");
  const YamlField lights = field.at("lights");
  for (const YamlField& light : lights.items()) {
    const std::string name = light.text();
    if (!known(rig.scene.lights, name)) light.fail("no such light in lights");
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
    const std::array<double, 3> rgb = rgb_not_negative(*ambient);
    rig.truth.ambient_irradiance_W_per_mm2 = {rgb[0], rgb[1], rgb[2]};
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
    CameraPlacement truth{pose->at("position_mm").vector3(), pose->at("look_at_mm").vector3()};
    if (const auto f = pose->find("up")) truth.up = unit_vector(*f);
    const Eigen::Vector3d forward = truth.look_at_mm - truth.position_mm;
    if (!(forward.cross(truth.up).norm() > 1e-9 * forward.norm())) {
      pose->fail("position_mm, look_at_mm and up do not define a camera");
    }
    rig.truth.pose = truth;
  }
}

// Intensities of calibrated LEDs count for a responsivity of their own. A rig without one takes it,
// and its scale is as well known as they are; a rig with another one is wrong.
void take_responsivity_of_leds(const YamlField& lights, Rig& rig) {
  const LedLight* first = nullptr;
  for (const SceneLight& light : rig.scene.lights) {
    const LedLight* led = light.led();
    if (led == nullptr || !led->calibrated_for) continue;
    const YamlField field = lights.at(light.name).at("calibration");
    if (first == nullptr && !rig.scene.camera.responsivity) {
      for (const SceneLight& other : rig.scene.lights) {
        const bool counts = other.led() != nullptr && other.led()->calibrated_for;
        if (!counts && !other->is_fitted()) {
          field.fail("its intensity counts for the responsivity that the file states; light " +
                     other.name +
                     " has no such calibration, so camera.responsivity_counts_mm2_sr_per_W_s must "
                     "say what both count for");
        }
      }
      rig.scene.camera.responsivity = led->calibrated_for;
      rig.scene.camera.responsivity_relative_std = 0.0;
    }
    first = led;
    for (std::size_t c = 0; c < 3; ++c) {
      if (std::abs((*led->calibrated_for)[c] / (*rig.scene.camera.responsivity)[c] - 1.0) > 1e-9) {
        field.fail("its intensity counts for a responsivity of " +
                   std::to_string((*led->calibrated_for)[c]) + ", the camera's is " +
                   std::to_string((*rig.scene.camera.responsivity)[c]) + " (" + "RGB"[c] + ")");
      }
    }
  }
}

}  // namespace

Rig read_rig(const std::string& path, bool with_radiance) {
  const YamlField top = YamlField::load(path);
  top.only({"scattermeter_rig", "limits", "camera", "pose", "objects", "lights", "shots",
            "calibration", "truth"});
  const YamlField version = top.at("scattermeter_rig");
  if (version.number() != 1.0) version.fail("this program reads rigs of version 1");
  Rig rig;
  rig.path = path;
  rig.limits = read_limits(top);
  rig.decoding.max_megapixels = rig.limits.raw_megapixels;
  rig.scene.source = path;
  read_camera(top.at("camera"), with_radiance, rig);
  check_image_size(top.at("camera").at("image_size_px"), rig.limits);
  rig.pose = read_pose(top.at("pose"));
  for (const auto& [name, field] : top.at("objects").entries()) {
    rig.scene.objects.push_back(read_object(name, field, path));
  }
  const YamlField lights = top.at("lights");
  for (const auto& [name, field] : lights.entries()) {
    rig.scene.lights.push_back(read_light(name, field, path, rig.limits));
  }
  take_responsivity_of_leds(lights, rig);
  std::set<std::string> files;
  const YamlField shots = top.at("shots");
  for (const YamlField& field : shots.items()) {
    rig.scene.shots.push_back(read_shot(field, rig));
    for (const std::string& file : rig.scene.shots.back().files()) {
      if (!files.insert(file).second) {
        field.at("file").fail("two shots of the same name: " + file);
      }
    }
  }
  if (rig.scene.shots.empty()) shots.fail("expected at least one shot");
  if (const auto f = top.find("calibration")) rig.calibration = read_calibration(*f, path);
  if (rig.calibration.radiance && rig.calibration.radiance->white) {
    const std::string& name = rig.calibration.radiance->white->light;
    const bool is_led =
        std::any_of(rig.scene.lights.begin(), rig.scene.lights.end(),
                    [&](const SceneLight& l) { return l.name == name && l.led() != nullptr; });
    if (!is_led) {
      top.at("calibration").at("radiance").at("white").at("light").fail("no such LED in lights");
    }
  }
  if (const auto truth = top.find("truth")) read_truth(*truth, rig);
  return rig;
}

}  // namespace scattermeter::apps
