#include "tests/apps/small_rig.h"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "apps/camera_view.h"
#include "calib/camera_model.h"

namespace scattermeter::apps {
namespace {

// Survey marks around the object, projected without error.
std::string pose_points() {
  calib::CameraIntrinsics k;
  k.width_px = 484;
  k.height_px = 324;
  k.fx_px = k.fy_px = 1229.5;
  k.cx_px = 241.8;
  k.cy_px = 161.2;
  const Rigid3d camera_from_world = look_at({0, -100, 150}, {0, 0, 9}, {0, 0, 1});
  const std::vector<Eigen::Vector3d> marks = {{-26, -14, 0}, {26, -14, 0}, {26, 20, 0},
                                              {-26, 20, 0},  {0, -16, 0},  {-28, -8, 12},
                                              {28, -8, 12},  {24, 16, 15}};
  std::ostringstream out;
  const std::vector<Eigen::Vector2d> px = calib::project(k, camera_from_world, marks);
  for (std::size_t i = 0; i < marks.size(); ++i) {
    out << "    - {world_mm: [" << marks[i].x() << ", " << marks[i].y() << ", " << marks[i].z()
        << "], image_px: [" << px[i].x() << ", " << px[i].y() << "]}\n";
  }
  return out.str();
}

std::string rig_text() {
  std::ostringstream out;
  out << R"(scattermeter_rig: 1
camera:
  model: NIKON D80
  image_size_px: [484, 324]
  intrinsics: {fx_px: 1229.5, fy_px: 1229.5, cx_px: 241.8, cy_px: 161.2}
  responsivity_counts_mm2_sr_per_W_s: [2.4e10, 2.9e10, 2.1e10]
  responsivity_relative_std: 0.01
  sensor: {gain_e_per_count: 6.0, read_noise_counts: 1.2, black_counts: 64}
  exposure_s: 0.05
pose:
  points:
)" << pose_points()
      << R"(objects:
  cube: {mesh: cube.obj, eta: 1.4}
  pyramid: {mesh: pyramid.obj, eta: 1.4}
lights:
  led1: {type: led, position_mm: [30, -60, 80], axis: [-30, 60, -70], exponent: 1, intensity_W_per_sr: [0.05, 0.05, 0.05]}
  led2: {type: led, position_mm: [-70, -20, 60], axis: [70, 20, -50], exponent: 1, intensity_W_per_sr: [0.05, 0.05, 0.05]}
shots:
)";
  for (const char* material : {"PP", "PE", "POM"}) {
    for (const char* object : {"cube", "pyramid"}) {
      for (int led : {1, 2}) {
        out << "  - {file: " << material << "_" << object << "_" << led
            << ".dng, object: " << object << ", material: " << material << ", lights: [led" << led
            << "]}\n";
      }
    }
  }
  out << R"(truth:
  materials:
    PP: {sigma_s_prime_per_mm: [0.50, 0.62, 0.70], sigma_a_per_mm: [0.003, 0.002, 0.004]}
    PE: {sigma_s_prime_per_mm: [0.90, 1.05, 1.20], sigma_a_per_mm: [0.002, 0.003, 0.006]}
    POM: {sigma_s_prime_per_mm: [1.40, 1.60, 1.75], sigma_a_per_mm: [0.002, 0.004, 0.008]}
)";
  return out.str();
}

}  // namespace

Answer run(const std::vector<std::string>& arguments) {
  std::ostringstream out, err;
  Answer r;
  r.status = run_command_line(arguments, out, err);
  r.out = out.str();
  r.err = err.str();
  return r;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  if (at == std::string::npos || text.find(from, at + 1) != std::string::npos) {
    throw std::logic_error("replaced: not exactly one of: " + from);
  }
  return text.replace(at, from.size(), to);
}

std::string slurp(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

SmallRig::SmallRig() {
  write(rig_text());
  const std::string samples = std::string(SCATTERMETER_SOURCE_DIR) + "/samples/three_plastics/";
  write_file(folder_ / "cube.obj", slurp(samples + "cube.obj"));
  write_file(folder_ / "pyramid.obj", slurp(samples + "pyramid_on_pedestal.obj"));
}

void SmallRig::write(const std::string& text) {
  text_ = text;
  write_file(rig(), text);
}

void SmallRig::keep_shots(const std::string& holding) {
  std::istringstream in(text_);
  std::string kept;
  for (std::string line; std::getline(in, line);) {
    if (line.find("{file:") == std::string::npos || line.find(holding) != std::string::npos) {
      kept += line + "\n";
    }
  }
  write(kept);
}

void SmallRig::simulate(const std::vector<std::string>& more) {
  std::vector<std::string> arguments = {"simulate", rig(), "--out", shots()};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const Answer r = run(arguments);
  if (r.status != 0) throw std::runtime_error("simulate failed: " + r.err);
}

Answer SmallRig::measure(const std::vector<std::string>& more) const {
  std::vector<std::string> arguments = {"measure", shots(), "--rig", rig(), "--out", out()};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return run(arguments);
}

std::string SmallRig::result() const { return slurp(out() + "/result.json"); }

}  // namespace scattermeter::apps
