#include "apps/plastics_rig.h"

#include <stdexcept>
#include <string>

namespace scattermeter::apps {
namespace {

// Cuts a quadrilateral, counter-clockwise from outside, in two.
void add_quad(TriangleMesh& mesh, int a, int b, int c, int d) {
  mesh.triangles.push_back({a, b, c});
  mesh.triangles.push_back({a, c, d});
}

// Four corners of a square about the z axis, counter-clockwise from above.
void add_square(TriangleMesh& mesh, double half_mm, double z_mm) {
  for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
    mesh.vertices_mm.emplace_back(x * half_mm, y * half_mm, z_mm);
  }
}

// Bands between neighbouring squares, from the first to the last; `first` below.
void add_band(TriangleMesh& mesh, int lower, int upper) {
  for (int i = 0; i < 4; ++i) {
    const int j = (i + 1) % 4;
    add_quad(mesh, lower + i, lower + j, upper + j, upper + i);
  }
}

RigLight led(const std::string& name, const Eigen::Vector3d& position_mm,
             const Eigen::Vector3d& towards) {
  RigLight light;
  light.name = name;
  light.led.position_mm = position_mm;
  light.led.axis = towards.normalized();
  light.led.exponent = 1.0;
  light.led.intensity_W_per_sr = {0.050, 0.052, 0.047};
  return light;
}

std::array<Medium, 3> medium(const std::array<double, 3>& s, const std::array<double, 3>& a) {
  return {Medium{s[0], a[0], 1.0}, Medium{s[1], a[1], 1.0}, Medium{s[2], a[2], 1.0}};
}

}  // namespace

TriangleMesh cube_mesh() {
  TriangleMesh mesh;
  add_square(mesh, 10, 0);
  add_square(mesh, 10, 20);
  add_quad(mesh, 3, 2, 1, 0);
  add_band(mesh, 0, 4);
  add_quad(mesh, 4, 5, 6, 7);
  return mesh;
}

TriangleMesh pyramid_on_pedestal_mesh() {
  TriangleMesh mesh;
  add_square(mesh, 11, 0);
  add_square(mesh, 11, 7);
  add_square(mesh, 8, 7);
  mesh.vertices_mm.emplace_back(0, 0, 20);
  add_quad(mesh, 3, 2, 1, 0);
  add_band(mesh, 0, 4);
  add_band(mesh, 4, 8);
  for (int i = 0; i < 4; ++i) mesh.triangles.push_back({8 + i, 8 + (i + 1) % 4, 12});
  return mesh;
}

Rig plastics_rig(int image_width_px) {
  if (image_width_px < 240 || image_width_px > 3872) {
    throw std::invalid_argument("plastics_rig: a width of 240 .. 3872 px expected, got " +
                                std::to_string(image_width_px));
  }
  Rig rig;
  rig.path = "plastics_rig";
  RigCamera& camera = rig.camera;
  const double shrink = image_width_px / 3872.0;
  camera.model = "NIKON D80";
  camera.intrinsics.width_px = image_width_px / 2 * 2;
  camera.intrinsics.height_px = image_width_px / 3 / 2 * 2;
  // A 60 mm macro lens on a sensor of 6.1 um pitch.
  camera.intrinsics.fx_px = camera.intrinsics.fy_px = 9836.0 * shrink;
  camera.intrinsics.cx_px = 1941.3 * shrink;
  camera.intrinsics.cy_px = 1290.7 * shrink;
  camera.intrinsics.distortion = {-0.03, 0.05, 0.0002, -0.0001, 0};
  camera.responsivity = {2.4e10, 2.9e10, 2.1e10};
  camera.responsivity_relative_std = 0.0;
  camera.sensor.noise = {6.0, 1.2};
  camera.exposure_s = 0.1;
  camera.f_number = 11.0;

  rig.truth_pose = RigTruthPose{{0, -100, 150}, {0, 0, 9}};
  const std::vector<Eigen::Vector3d> marks_mm = {
      {-26, -14, 0}, {26, -14, 0},  {26, 20, 0},   {-26, 20, 0}, {-26, 3, 0},
      {26, 3, 0},    {0, -16, 0},   {-12, -16, 0}, {14, -15, 0}, {-28, -8, 12},
      {28, -8, 12},  {-24, 16, 15}, {24, 16, 15},  {0, 19, 0}};
  const std::vector<Eigen::Vector2d> marks_px = calib::project(
      camera.intrinsics,
      look_at(rig.truth_pose->position_mm, rig.truth_pose->look_at_mm, rig.truth_pose->up),
      marks_mm);
  for (std::size_t i = 0; i < marks_mm.size(); ++i) {
    rig.pose.points.push_back({marks_mm[i], marks_px[i]});
  }
  rig.pose.options.point_std_px = 0.001;

  for (const char* name : {"cube", "pyramid"}) {
    RigObject object;
    object.name = name;
    object.eta_int_over_ext = 1.49;
    rig.objects.push_back(object);
  }
  rig.lights = {led("led1", {30, -60, 80}, {-30, 60, -70}),
                led("led2", {-70, -20, 60}, {70, 20, -50})};
  for (const char* material : {"PP", "PE", "POM"}) {
    for (const char* object : {"cube", "pyramid"}) {
      for (const char* number : {"1", "2"}) {
        RigShot shot;
        shot.file = std::string(material) + "_" + object + "_" + number + ".dng";
        shot.object = object;
        shot.material = material;
        shot.lights = {std::string("led") + number};
        rig.shots.push_back(shot);
      }
    }
  }
  rig.truth_materials["PP"] = medium({0.62, 0.70, 0.80}, {0.0012, 0.0010, 0.0018});
  rig.truth_materials["PE"] = medium({1.15, 1.32, 1.50}, {0.0016, 0.0013, 0.0026});
  rig.truth_materials["POM"] = medium({2.19, 2.45, 2.70}, {0.0020, 0.0024, 0.0041});
  return rig;
}

ObjectScenes plastics_scenes(const Rig& rig) {
  return open_objects(rig, [](const RigObject& object) {
    return object.name == "cube" ? cube_mesh() : pyramid_on_pedestal_mesh();
  });
}

}  // namespace scattermeter::apps
