#include "apps/simulate.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <system_error>

#include <fmt/core.h>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include "apps/board_picture.h"
#include "apps/camera_view.h"
#include "apps/object_scene.h"
#include "apps/progress.h"
#include "apps/rig_probes.h"
#include "apps/shot_pose.h"
#include "capture/dng_writer.h"
#include "capture/sensor.h"
#include "capture/tone_curve.h"
#include "core/cfa_samples.h"
#include "core/dipole_image.h"
#include "core/environment_light.h"
#include "core/fresnel.h"
#include "core/input_error.h"
#include "core/shade_map.h"

namespace scattermeter::apps {
namespace {

constexpr double kSmoothPatches = 60.0;  // across an object, for the light of an environment
constexpr double kExposedTo = 0.75;      // of the range, for a chosen exposure

CameraView true_view(const Rig& rig) {
  if (rig.truth_pose) {
    const RigTruthPose& t = *rig.truth_pose;
    return {rig.camera.intrinsics, look_at(t.position_mm, t.look_at_mm, t.up)};
  }
  if (rig.pose.charuco) {
    throw InputError(
        rig.at(rig.pose.line) + ": truth.pose",
        "is missing: a rig whose pose comes from a board in the shots cannot be simulated "
        "without it");
  }
  return {rig.camera.intrinsics, pose_from_points(rig).camera_from_world};
}

const std::array<Medium, 3>& truth_of(const Rig& rig, const RigShot& shot) {
  const auto it = rig.truth_materials.find(shot.material);
  if (it == rig.truth_materials.end()) {
    throw InputError(rig.at(shot.line) + ": truth.materials." + shot.material,
                     "is missing: simulate needs the truth of every material in shots");
  }
  return it->second;
}

// An object from the camera, with the light of each LED (one) or environment (R, G, B) on it;
// shared by its shots.
struct Stage {
  std::unique_ptr<PatchMesh> patches;
  std::unique_ptr<ShadeMap> pixels;
  std::vector<bool> needed;
  std::map<std::string, std::vector<IncidentLight>> lights;
};

class Simulator {
 public:
  Simulator(const Rig& rig, const SimulateOptions& options)
      : rig_(rig),
        options_(options),
        scenes_(open_objects(rig)),
        probes_(open_probes(rig)),
        view_(true_view(rig)) {
    for (const RigShot& shot : rig.shots) truth_of(rig, shot);
    for (std::size_t p = 0; p < 4; ++p) {
      channel_of_phase_[p] = static_cast<int>(rig.camera.sensor.cfa.phase[p]);
    }
  }

  std::vector<std::string> run(const std::string& out_folder) {
    Progress progress("rendering", static_cast<int>(2 * rig_.shots.size()), options_.quiet);
    for (const RigShot& shot : rig_.shots) {
      fields_.push_back(render(shot));
      progress.step();
    }
    choose_exposure();
    std::vector<std::string> paths;
    for (std::size_t i = 0; i < rig_.shots.size(); ++i) {
      paths.push_back((std::filesystem::path(out_folder) / rig_.shots[i].file).string());
      shoot(i, paths.back());
      progress.step();
    }
    return paths;
  }

 private:
  Stage& stage(const std::string& object) {
    auto [it, is_new] = stages_.try_emplace(object);
    if (is_new) {
      const ObjectScene& scene = scenes_.at(object);
      require_in_view(rig_, scenes_, view_, object);
      double patch_mm = scene.size_mm();
      for (const RigShot& shot : rig_.shots) {
        if (shot.object == object) {
          patch_mm =
              std::min(patch_mm, render_patch_size_mm(truth_of(rig_, shot), scene.size_mm()));
        }
      }
      Stage& s = it->second;
      s.patches = std::make_unique<PatchMesh>(scene.mesh(), patch_mm);
      s.pixels = std::make_unique<ShadeMap>(rays_around(view_, scene.mesh(), 2), *scene.rays,
                                            *s.patches, scene.rig->eta_int_over_ext);
      s.needed = s.pixels->needed_patches(s.patches->size());
    }
    return it->second;
  }

  std::vector<IncidentLight> light_on(const RigLight& light, const ObjectScene& scene,
                                      const PatchMesh& patches) const {
    const double eta = scene.rig->eta_int_over_ext;
    if (!light.environment) return {illuminate(patches, *scene.rays, light.led, eta)};
    // An environment's light is smooth but for edges that are found on any patches.
    const PatchMesh coarse(scene.mesh(),
                           std::max(patches.patch_size_mm(), scene.size_mm() / kSmoothPatches));
    const auto rgb = illuminate(coarse, *scene.rays, probes_.at(light.name), eta);
    return {rgb.begin(), rgb.end()};
  }

  SurfaceField render(const RigShot& shot) {
    Stage& s = stage(shot.object);
    const ObjectScene& scene = scenes_.at(shot.object);
    std::array<Medium, 3> media = truth_of(rig_, shot);
    for (Medium& m : media) m.eta_int_over_ext = scene.rig->eta_int_over_ext;
    SurfaceField field(*s.patches, s.needed);
    for (const std::string& name : shot.lights) {
      const RigLight& light = rig_.light(name);
      const auto [it, is_new] = s.lights.try_emplace(name);
      if (is_new) it->second = light_on(light, scene, *s.patches);
      for (std::size_t c = 0; c < it->second.size(); ++c) {
        Eigen::Array3d power = light.power();
        if (light.environment) {
          power.setZero();
          power[static_cast<Eigen::Index>(c)] = light.power()[static_cast<Eigen::Index>(c)];
        }
        if (it->second[c].lit.empty()) continue;
        field.add(dipole_radiosity(field.nodes_mm(), it->second[c], scene.box.center_mm(),
                                   1.001 * scene.diagonal_mm(), media, power));
      }
    }
    return field;
  }

  // Fills responsivity_ and default_exposure_s_ where the rig leaves them open.
  void choose_exposure() {
    // Radiance at normal exit of the brightest place: an upper bound for every pixel.
    Eigen::Array3d brightest = Eigen::Array3d::Zero();
    for (std::size_t i = 0; i < fields_.size(); ++i) {
      const double eta = scenes_.at(rig_.shots[i].object).rig->eta_int_over_ext;
      brightest =
          brightest.max(fields_[i].max() * fresnel_transmittance(eta, 1.0) / std::numbers::pi);
    }
    const RigSensor& sensor = rig_.camera.sensor;
    const double top = sensor.nef_lossy_curve ? std::min<double>(sensor.white_counts,
                                                                 capture::nef_lossy_curve().back())
                                              : sensor.white_counts;
    const double range = kExposedTo * (top - *std::max_element(sensor.black_counts.begin(),
                                                               sensor.black_counts.end()));
    if (rig_.camera.responsivity) {
      responsivity_ = *rig_.camera.responsivity;
      double peak = 0.0;
      for (std::size_t c = 0; c < 3; ++c) {
        peak = std::max(peak, responsivity_[c] * brightest[static_cast<Eigen::Index>(c)]);
      }
      // Two digits, rounded down.
      const double exact_s = peak > 0.0 ? range / peak : 1.0;
      const double unit = std::pow(10.0, std::floor(std::log10(exact_s)) - 1.0);
      default_exposure_s_ = std::floor(exact_s / unit) * unit;
    } else {
      default_exposure_s_ = rig_.camera.exposure_s.value_or(0.1);
      const double peak = brightest.maxCoeff();
      responsivity_.fill(peak > 0.0 ? range / (peak * default_exposure_s_) : 1.0);
    }
  }

  void shoot(std::size_t i, const std::string& path) {
    const RigShot& shot = rig_.shots[i];
    const RigCamera& camera = rig_.camera;
    const int width = camera.intrinsics.width_px;
    const int height = camera.intrinsics.height_px;
    const double exposure_s =
        shot.exposure_s.value_or(camera.exposure_s.value_or(default_exposure_s_));
    std::vector<float> signal(static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
                              0.0F);
    const Stage& s = stages_.at(shot.object);
    const ShadeMap& pixels = *s.pixels;
    tbb::parallel_for(0, pixels.height(), [&](int y) {
      for (int x = 0; x < pixels.width(); ++x) {
        const int xx = pixels.x0() + x;
        const int yy = pixels.y0() + y;
        signal[static_cast<std::size_t>(yy) * static_cast<std::size_t>(width) +
               static_cast<std::size_t>(xx)] =
            static_cast<float>(pixels.radiance(x, y, fields_[i], channel(xx, yy)));
      }
    });
    if (rig_.pose.charuco) {
      std::vector<Led> leds;
      const Eigen::Vector3d normal =
          rig_.pose.charuco->world_from_board.rotation * Eigen::Vector3d::UnitZ();
      Eigen::Array3d ambient = Eigen::Array3d::Zero();
      for (const std::string& name : shot.lights) {
        const RigLight& light = rig_.light(name);
        if (light.environment) {
          ambient += light.power() * open_irradiance(probes_.at(name), normal, 1.0);
        } else {
          leds.push_back(light.led);
        }
      }
      add_board(view_, *rig_.pose.charuco, leds, ambient, *scenes_.at(shot.object).rays,
                channel_of_phase_, signal);
    }
    tbb::parallel_for(0, height, [&](int y) {
      for (int x = 0; x < width; ++x) {
        signal[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
               static_cast<std::size_t>(x)] *=
            static_cast<float>(responsivity_[static_cast<std::size_t>(channel(x, y))] * exposure_s);
      }
    });
    const RigSensor& rig_sensor = camera.sensor;
    capture::SensorModel sensor;
    sensor.noise = rig_sensor.noise;
    sensor.black_counts = rig_sensor.black_counts;
    sensor.white_counts = rig_sensor.white_counts;
    if (rig_sensor.nef_lossy_curve) sensor.tone_curve = capture::nef_lossy_curve();
    sensor.noise_on = options_.noise;
    capture::DngMetadata metadata;
    set_camera_name(metadata);
    metadata.cfa = rig_sensor.cfa;
    metadata.black_counts = rig_sensor.black_counts;
    metadata.white_counts = rig_sensor.white_counts;
    metadata.exposure_s = exposure_s;
    metadata.iso = camera.iso;
    metadata.f_number = camera.f_number;
    metadata.linearization_table = sensor.tone_curve;
    // Each shot its own stream of the seed.
    const std::uint64_t seed = options_.seed * 1'000'003ULL + i;
    capture::write_dng(path, width, height, capture::expose(signal, width, height, sensor, seed),
                       metadata);
  }

  int channel(int x, int y) const { return channel_of_phase_[cfa_phase(x, y)]; }

  // "NIKON D80" is model D80 by NIKON; cameras write both tags with the maker's name in the model.
  void set_camera_name(capture::DngMetadata& metadata) const {
    if (rig_.camera.model.empty()) return;
    metadata.model = rig_.camera.model;
    metadata.make = rig_.camera.model.substr(0, rig_.camera.model.find(' '));
  }

  const Rig& rig_;
  SimulateOptions options_;
  ObjectScenes scenes_;
  RigProbes probes_;
  CameraView view_;
  std::array<int, 4> channel_of_phase_{};
  std::map<std::string, Stage> stages_;
  std::vector<SurfaceField> fields_;
  std::array<double, 3> responsivity_{};
  double default_exposure_s_ = 0;
};

}  // namespace

std::vector<std::string> simulate(const Rig& rig, const std::string& out_folder,
                                  const SimulateOptions& options) {
  Simulator simulator(rig, options);
  std::error_code error;
  std::filesystem::create_directories(out_folder, error);
  if (error) throw InputError(out_folder, "the folder cannot be made: " + error.message());
  return simulator.run(out_folder);
}

}  // namespace scattermeter::apps
