#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include "apps/instrument/measure.h"
#include "apps/python/array_light.h"
#include "apps/python/bindings.h"
#include "apps/python/dict_field.h"
#include "apps/python/python_progress.h"
#include "apps/results/result_json.h"
#include "core/base/input_error.h"
#include "core/estimation/estimate.h"
#include "core/scene/default_uncertainty.h"
#include "core/scene/seen_object.h"
#include "core/scene/surroundings.h"
#include "core/view/observation.h"

namespace py = pybind11;

namespace scattermeter::python {
namespace {

using Points = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
using Triangles = Eigen::Matrix<int, Eigen::Dynamic, 3, Eigen::RowMajor>;
using Pixels = Eigen::Matrix<int, Eigen::Dynamic, 2, Eigen::RowMajor>;

SceneCamera scene_camera(const py::dict& dict) {
  SceneCamera camera;
  const std::string where = "camera";
  CameraIntrinsics& k = camera.intrinsics;
  const auto size = field<std::array<int, 2>>(dict, where, "image_size_px");
  k.width_px = size[0];
  k.height_px = size[1];
  k.fx_px = field<double>(dict, where, "fx_px");
  k.fy_px = field<double>(dict, where, "fy_px");
  k.cx_px = field<double>(dict, where, "cx_px");
  k.cy_px = field<double>(dict, where, "cy_px");
  k.distortion = field<std::vector<double>>(dict, where, "distortion", {});
  if (const std::string problem = intrinsics_problem(k); !problem.empty()) {
    throw InputError(where, problem);
  }
  if (dict.contains("responsivity_counts_mm2_sr_per_W_s")) {
    camera.responsivity =
        field<std::array<double, 3>>(dict, where, "responsivity_counts_mm2_sr_per_W_s");
  }
  camera.responsivity_relative_std =
      field<double>(dict, where, "responsivity_relative_std", camera.responsivity_relative_std);
  camera.sensor.cfa = cfa_pattern_from_name(field<std::string>(dict, where, "cfa", "RGGB"));
  return camera;
}

TriangleMesh triangle_mesh(const py::dict& dict, const std::string& where) {
  TriangleMesh mesh;
  const auto vertices = field<Points>(dict, where, "vertices_mm");
  const auto triangles = field<Triangles>(dict, where, "triangles");
  for (Eigen::Index i = 0; i < vertices.rows(); ++i) {
    mesh.vertices_mm.emplace_back(vertices.row(i).transpose());
  }
  for (Eigen::Index i = 0; i < triangles.rows(); ++i) {
    for (int k = 0; k < 3; ++k) {
      if (triangles(i, k) < 0 || triangles(i, k) >= vertices.rows()) {
        throw InputError(where + ".triangles", "row " + std::to_string(i) +
                                                   " names a vertex that is not there: " +
                                                   std::to_string(triangles(i, k)));
      }
    }
    mesh.triangles.push_back({triangles(i, 0), triangles(i, 1), triangles(i, 2)});
  }
  return mesh;
}

// Reads the samples of one shot: position in the frame, counts above black, variance.
struct GivenSamples {
  Pixels xy_px;
  Eigen::VectorXd value_counts;
  Eigen::VectorXd variance_counts2;
  double exposure_s = 1;
  double variance_per_count = 0;
};

CfaSamples in_rectangle(const GivenSamples& given, const SceneCamera& camera,
                        const SampleMap& map) {
  CfaSamples out;
  out.x0 = map.x0;
  out.y0 = map.y0;
  out.width = map.width;
  out.height = map.height;
  for (std::size_t p = 0; p < 4; ++p) {
    out.channel_of_phase[p] = static_cast<int>(camera.sensor.cfa.phase[p]);
  }
  out.exposure_s = given.exposure_s;
  out.variance_per_count = given.variance_per_count;
  const auto n = static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height);
  out.signal_counts.assign(n, 0.0F);
  out.variance_counts2.assign(n, 1.0F);
  out.clipped.assign(n, kSampleDefect);  // samples that are not given are unused
  for (Eigen::Index i = 0; i < given.xy_px.rows(); ++i) {
    const int x = given.xy_px(i, 0) - map.x0;
    const int y = given.xy_px(i, 1) - map.y0;
    if (x < 0 || y < 0 || x >= map.width || y >= map.height) continue;
    const auto at = static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width) +
                    static_cast<std::size_t>(x);
    out.signal_counts[at] = static_cast<float>(given.value_counts[i]);
    out.variance_counts2[at] = static_cast<float>(given.variance_counts2[i]);
    out.clipped[at] = 0;
  }
  return out;
}

struct GivenShot {
  PoseResult pose;
  GivenSamples samples;
};

GivenShot given_shot(const py::dict& dict, const std::string& where) {
  GivenShot out;
  const auto m = field<Eigen::Matrix4d>(dict, where, "camera_from_world");
  out.pose.status = PoseStatus::kOk;
  out.pose.camera_from_world.rotation =
      Eigen::Quaterniond(Eigen::Matrix3d(m.topLeftCorner<3, 3>())).normalized();
  out.pose.camera_from_world.translation_mm = m.topRightCorner<3, 1>();
  out.pose.covariance = field<Eigen::MatrixXd>(dict, where, "pose_covariance",
                                               Eigen::MatrixXd(Eigen::MatrixXd::Zero(6, 6)));
  GivenSamples& s = out.samples;
  s.xy_px = field<Pixels>(dict, where, "xy_px");
  s.value_counts = field<Eigen::VectorXd>(dict, where, "value_counts");
  s.variance_counts2 = field<Eigen::VectorXd>(dict, where, "variance_counts2");
  s.exposure_s = field<double>(dict, where, "exposure_s");
  s.variance_per_count = field<double>(dict, where, "variance_per_count", 0.0);
  if (s.value_counts.size() != s.xy_px.rows() || s.variance_counts2.size() != s.xy_px.rows()) {
    throw InputError(where, "xy_px, value_counts and variance_counts2 differ in length: " +
                                std::to_string(s.xy_px.rows()) + ", " +
                                std::to_string(s.value_counts.size()) + ", " +
                                std::to_string(s.variance_counts2.size()));
  }
  if (!(s.variance_counts2.array() > 0.0).all()) {
    throw InputError(where + ".variance_counts2", "has values that are not positive");
  }
  return out;
}

// Distance of the farthest object from the camera that sees it.
double farthest_mm(const Scene& scene, const ObjectScenes& objects,
                   const std::vector<GivenShot>& shots) {
  double out = 0.0;
  for (std::size_t i = 0; i < shots.size(); ++i) {
    const CameraView view{scene.camera.intrinsics, shots[i].pose.camera_from_world};
    const Eigen::Vector3d object_mm = objects.at(scene.shots[i].object).box.center_mm();
    out = std::max(out, (view.center_in_world_mm() - object_mm).norm());
  }
  return out;
}

std::string estimate_arrays(const py::dict& camera, const py::dict& objects, const py::dict& lights,
                            const std::vector<py::dict>& shots, const std::string& model,
                            std::optional<double> patch_size_mm, double time_limit_s,
                            double even_light_share_std, const py::object& progress) {
  Scene scene;
  scene.even_light_share_std = even_light_share_std;
  scene.source = "estimate";
  scene.camera = scene_camera(camera);
  std::vector<TriangleMesh> meshes;
  for (const auto& [name, value] : objects) {
    const auto dict = value.cast<py::dict>();
    SceneObject& object = scene.objects.emplace_back();
    object.name = name.cast<std::string>();
    const std::string where = "objects." + object.name;
    object.mesh_path = where;
    object.eta_int_over_ext = field<double>(dict, where, "eta");
    object.eta_std = deviation(dict, where, "eta_std", default_uncertainty::kEta);
    const bool stated = dict.contains("g");
    object.phase = stated ? field<double>(dict, where, "g") : 0.0;
    object.gamma_std =
        deviation(dict, where, "gamma_std",
                  stated ? default_uncertainty::kStatedGamma : default_uncertainty::kGamma);
    object.position_std_mm =
        deviation(dict, where, "position_std_mm", default_uncertainty::kObjectPosition_mm);
    object.scale_relative_std =
        deviation(dict, where, "scale_relative_std", default_uncertainty::kMeshScale);
    object.surface_alpha_std =
        deviation(dict, where, "surface_alpha_std", default_uncertainty::kSurfaceAlpha);
    object.edge_std_mm = deviation(dict, where, "edge_std_mm", default_uncertainty::kEdge_mm);
    meshes.push_back(triangle_mesh(dict, where));
  }
  for (const auto& [name, value] : lights) {
    scene.lights.push_back(scene_light(name.cast<std::string>(), value.cast<py::dict>()));
  }
  std::vector<GivenShot> given;
  for (std::size_t i = 0; i < shots.size(); ++i) {
    const std::string where = "shots[" + std::to_string(i) + "]";
    SceneShot& shot = scene.shots.emplace_back();
    shot.file = field<std::string>(shots[i], where, "name", "shot " + std::to_string(i));
    shot.object = field<std::string>(shots[i], where, "object");
    shot.material = field<std::string>(shots[i], where, "material");
    shot.lights = field<std::vector<std::string>>(shots[i], where, "lights");
    given.push_back(given_shot(shots[i], where));
  }
  EstimateOptions options;
  options.model = estimator(model).name;
  options.time_limit_s = time_limit_s;
  apps::Measurement measurement;
  measurement.model = options.model;
  run_interruptible(progress, [&](Progress& p) {
    require_known_names(scene);
    ObjectScenes geometry;
    for (std::size_t i = 0; i < meshes.size(); ++i) {
      geometry.emplace(scene.objects[i].name, object_scene(scene, scene.objects[i], meshes[i]));
    }
    require_lights_outside(scene, geometry);
    require_above_plane(scene, geometry);
    LitObjects lit(scene, geometry, patch_size_mm, farthest_mm(scene, geometry, given));
    std::vector<ObservedShot> observed(given.size());
    const auto responsivity =
        scene.camera.responsivity.value_or(std::array<double, 3>{1.0, 1.0, 1.0});
    for (std::size_t i = 0; i < given.size(); ++i) {
      ObservedShot& shot = observed[i];
      shot.stated = &scene.shots[i];
      shot.pose = given[i].pose;
      shot.has_own_pose = true;
      require_in_view(scene, geometry, {scene.camera.intrinsics, shot.pose.camera_from_world},
                      shot.stated->object);
      shot.seen = see(scene, geometry, lit, shot.stated->object, shot.pose);
      shot.exposure_s = given[i].samples.exposure_s;
      shot.observation = observe(in_rectangle(given[i].samples, scene.camera, shot.seen->map),
                                 shot.seen->map, responsivity);
    }
    measurement.results = estimate(scene, lit, observed, options, &p);
  });
  return apps::result_json(measurement);
}

}  // namespace

void add_estimate(py::module_& module) {
  module.def("estimate", &estimate_arrays, py::arg("camera"), py::arg("objects"), py::arg("lights"),
             py::arg("shots"), py::arg("model"), py::arg("patch_size_mm"), py::arg("time_limit_s"),
             py::arg("even_light_share_std"), py::arg("progress"));
}

}  // namespace scattermeter::python
