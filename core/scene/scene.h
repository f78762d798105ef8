// A measurement's scene as plain values: camera, objects, lights and shots.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include <Eigen/Core>

#include "core/camera/camera_model.h"
#include "core/camera/cfa_pattern.h"
#include "core/camera/cfa_samples.h"
#include "core/camera/lens_parameters.h"
#include "core/camera/rigid3d.h"
#include "core/camera/sensor_noise.h"
#include "core/light/ambient_light.h"
#include "core/light/diffuse_plane.h"
#include "core/light/distant_light.h"
#include "core/light/led_light.h"
#include "core/material/phase_function.h"

namespace scattermeter {

// Properties of the sensor. Simulated raws use all of them; for a real raw, black, white and filter
// phase come from the raw itself.
struct SceneSensor {
  SensorNoise noise;
  CfaPattern cfa;
  std::array<int, 4> black_counts = {64, 64, 64, 64};  // as CfaPattern::phase
  int white_counts = 4095;
  bool nef_lossy_curve = false;
};

struct SceneCamera {
  std::string model;  // "": any
  CameraIntrinsics intrinsics;
  LensRoot lens_root = LensRoot(kLensParameters, 0);
  // Counts per (W/(mm^2 sr)) and second, R G B; absent: the scale is free.
  std::optional<std::array<double, 3>> responsivity;
  double responsivity_relative_std = 0.02;
  // Standard deviation of the veiling glare left in the samples, as a share of the frame's mean in
  // the same channel.
  std::array<double, kRgb> glare_std{};
  // Standard deviation of the share of the light that is lost from the frame's centre to its
  // corners, in proportion to the distance squared.
  double vignetting_std = 0;
  // Standard deviation of the response's departure from proportionality to the light at the white
  // level; it grows in proportion to the counts (truth.sensor's non_linearity).
  double non_linearity_std = 0;
  SceneSensor sensor;
  std::optional<double> exposure_s;  // for simulated shots; absent: so that nothing clips
  int iso = 100;
  double f_number = 8.0;
};

// How a piece is found in the shots of it (calib/pose/piece_pose.h).
struct PieceSearch {
  bool is_on_plane = false;  // it stands as stated, but for x, y and a turn about the world's z
  bool is_per_shot = false;  // it was moved between its shots
};

struct SceneObject {
  std::string name;
  std::string piece;        // whose size it has, if that of several objects; "": its own
  std::string mesh_path;    // of a closed mesh, mm; for messages and for the code that reads it
  Rigid3d world_from_mesh;  // its position in the world
  std::optional<PieceSearch> to_be_found;  // that position is only about right
  double eta_int_over_ext = 1.3;
  double eta_std = 0;
  // Width of the surface's microfacets (RoughBoundary), 0: smooth; all materials of the object. The
  // deviation of 0: a smooth surface that may have the faint gloss of one so rough.
  double surface_alpha = 0;
  double surface_alpha_std = 0;
  PhaseFunction phase;
  double gamma_std = 0;  // of PhaseFunction::gamma()
  // Standard deviation of each coordinate of the object's position, world, mm; its orientation is
  // uncertain by the same amount at a distance of its own size.
  double position_std_mm = 0;
  double scale_relative_std = 0;  // of all lengths of the mesh
  double edge_std_mm = 0;         // how far the edges may be cut back from those of the mesh, mm
  std::optional<double> patch_size_mm;  // absent: chosen
  int line = 0;

  const std::string& piece_name() const { return piece.empty() ? name : piece; }
};

// A new kind of light is added here.
using LightKind = std::variant<LedLight, DistantLight, AmbientLight>;

struct SceneLight {
  std::string name;
  LightKind kind;
  std::vector<std::string> files;  // further files that describe it, besides the scene's own
  int line = 0;

  const Light& operator*() const;
  const Light* operator->() const { return &**this; }
  // The LED; null for other kinds of light.
  const LedLight* led() const { return std::get_if<LedLight>(&kind); }
  LedLight* led() { return std::get_if<LedLight>(&kind); }
  // The light's channel for a channel 0 .. 2 of the camera.
  std::size_t channel_of(std::size_t channel) const {
    return (*this)->channels() > 1 ? channel : 0;
  }
};

// The matt plane (table, stand) below the objects. Light that leaves an object and light of an LED
// that meet the plane are reflected towards the objects.
struct ScenePlane {
  double z_mm = 0;
  Eigen::Array3d albedo = Eigen::Array3d::Zero();      // R, G, B, 0 .. 1
  Eigen::Array3d albedo_std = Eigen::Array3d::Zero();  // >= 0; errors of the channels are separate
  PlaneContact contact = PlaneContact::kAir;
  int line = 0;

  // Whether it may change an image.
  bool matters() const { return (albedo > 0.0).any() || (albedo_std > 0.0).any(); }
  // As it is in a channel.
  DiffusePlane in(std::size_t channel) const {
    return {z_mm, albedo[static_cast<Eigen::Index>(channel)], contact};
  }
};

struct SceneSurroundings {
  std::optional<ScenePlane> plane;
};

struct SceneShot {
  std::string file;  // its name identifies the shot
  std::string object;
  std::string material;
  std::vector<std::string> lights;
  std::optional<double> exposure_s;  // of a simulated shot
  // A bracket: further exposures of the same scene, merged with the first, in whose counts the shot
  // is expressed.
  std::vector<std::string> more_files;
  std::vector<double> more_exposures_s;  // of more_files, or empty; for a simulated shot
  int line = 0;

  std::vector<std::string> files() const;  // the first and the others
};

struct Scene {
  // Standard deviation of unlisted, uniform light on each shot's object under LEDs, whose
  // irradiance is this share of the LEDs' on a surface that faces them; for shots that list no
  // ambient light.
  double even_light_share_std = 0;
  // Standard deviation of the shift of each shot's picture against the pose that all shots share,
  // right and down, px: a tripod that settles, a shutter that shakes.
  double shot_shift_std_px = 0;
  std::string source;  // the file that describes it, for messages; "": created in code
  SceneCamera camera;
  std::vector<SceneObject> objects;
  std::vector<SceneLight> lights;
  std::vector<SceneShot> shots;
  SceneSurroundings surroundings;

  const SceneObject& object(const std::string& name) const;  // std::out_of_range
  const SceneLight& light(const std::string& name) const;    // std::out_of_range
  // Of one of `shots`.
  std::size_t index_of(const SceneShot& shot) const {
    return static_cast<std::size_t>(&shot - shots.data());
  }
  // Materials in the order of their first shot.
  std::vector<std::string> materials() const;
  // The names of the objects that have shots.
  std::set<std::string> objects_in_shots() const;
  // "rig.yaml:12" for messages; without a line number (0), the source alone.
  std::string at(int line) const;
};

// Throws InputError naming the shot and the field unless every shot refers to an object and at
// least one light of the scene.
void require_known_names(const Scene& scene);

}  // namespace scattermeter
