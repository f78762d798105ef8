// Radiance of a rig's shots.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "apps/rig/open_objects.h"
#include "apps/rig/rig.h"
#include "core/camera/cfa_samples.h"
#include "core/diffusion/dipole_image.h"
#include "core/diffusion/shade_map.h"
#include "core/light/incident_light.h"
#include "core/mesh/patch_mesh.h"
#include "core/scene/lit_objects.h"
#include "core/transport/camera_connection.h"
#include "core/transport/path_boundary.h"
#include "core/transport/path_peers.h"
#include "core/view/camera_view.h"

namespace scattermeter::apps {

// Radiance, W/(mm^2 sr), each pixel in the channel of its own filter.
struct RadiancePicture {
  int x0 = 0, y0 = 0, width = 0, height = 0;  // px, in the frame
  std::vector<float> radiance;                // row by row
  // At normal exit from the brightest point of the object, per channel: an upper bound for its
  // pixels.
  Eigen::Array3d brightest = Eigen::Array3d::Zero();
};

// All three channels of each pixel, W/(mm^2 sr), R G B; the object alone on black.
struct ColourRadiance {
  int x0 = 0, y0 = 0, width = 0, height = 0;  // px, in the frame
  std::vector<float> rgb;                     // row by row
};

// How light propagates in the material.
struct RenderTransport {
  // By volumetric Monte Carlo (core/transport/path_tracer.h) with the values below; otherwise by
  // the dipole.
  bool volume = false;
  std::int64_t paths = 1'000'000;  // for each light of a shot and channel
  std::uint64_t seed = 1;
  PathPeers* peers = nullptr;  // processes that share the paths
};

// The camera of simulated shots: at truth.pose, otherwise at the pose from the pose points. Throws
// InputError if the rig has neither.
CameraView true_view(const Rig& rig);

// Renders shots one by one; the shots of an object share its patches, pixels and light. Rig and
// objects must outlive it. It must not be used by several threads at once (it uses all of them).
class ShotRenderer {
 public:
  // Throws InputError for a truth material or pose that the rig lacks, and for an invalid probe.
  ShotRenderer(const Rig& rig, const ObjectScenes& objects, const RenderTransport& transport = {});

  // Renders the rectangle around the object; with a board in the shots, the frame. Throws
  // InputError if the object is out of view.
  RadiancePicture render(const SceneShot& shot);
  // All channels of each pixel in the rectangle around the object, without a board.
  ColourRadiance render_colour(const SceneShot& shot);

  // Monte Carlo error of the shots rendered so far: the largest, over shots, lights and channels,
  // of the median relative deviation of a patch's light. 0 for the dipole.
  double monte_carlo_std() const { return monte_carlo_std_; }

  int channel(int x, int y) const {
    return static_cast<int>(rig_.scene.camera.sensor.cfa.at(x, y));
  }

 private:
  // An object as seen by the camera, with the light on it by name: one for an LED, R, G and B for
  // an environment.
  struct Stage {
    std::unique_ptr<PatchMesh> patches;
    std::unique_ptr<ShadeMap> pixels;
    std::vector<bool> needed;
    std::map<std::string, std::vector<IncidentLight>> lights;
    // Volume only.
    std::unique_ptr<PathBoundary> boundary;
    std::optional<CameraConnection> camera;
  };
  Stage& stage(const std::string& object);
  std::vector<IncidentLight> light_on(const Light& light, const ObjectScene& object,
                                      const PatchMesh& patches) const;
  SurfaceField light_from(const SceneShot& shot, Stage& s);
  SurfaceField field(const SceneShot& shot, Stage& s) const;
  // Adds what a rough surface reflects of an LED.
  void add_gloss(const SceneLight& light, const ObjectScene& object, const PatchMesh& patches,
                 const SurfaceField& field, std::vector<Eigen::Array3d>& values) const;
  SurfaceField volume_field(const SceneShot& shot, Stage& s);

  const Rig& rig_;
  const ObjectScenes& objects_;
  RenderTransport transport_;
  std::uint64_t runs_ = 0;  // of the Monte Carlo, each with its own seed
  double monte_carlo_std_ = 0;
  CameraView view_;
  std::map<std::string, Stage> stages_;
};

}  // namespace scattermeter::apps
