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

#include "apps/instrument/open_objects.h"
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
  // At normal exit of the brightest place of the object, per channel: an upper bound for its
  // pixels.
  Eigen::Array3d brightest = Eigen::Array3d::Zero();
};

// All three channels of each pixel, W/(mm^2 sr), R G B; the object alone on black.
struct ColourRadiance {
  int x0 = 0, y0 = 0, width = 0, height = 0;  // px, in the frame
  std::vector<float> rgb;                     // row by row
};

// How light moves in the material.
struct RenderTransport {
  bool volume =
      false;  // the volumetric Monte Carlo (core/transport/path_tracer.h); else the dipole
  std::int64_t paths = 1'000'000;  // Monte Carlo: for each light of a shot and channel
  std::uint64_t seed = 1;          // Monte Carlo
  PathPeers* peers = nullptr;      // Monte Carlo: processes that share the paths
};

// The camera that takes a simulated rig's shots: at truth.pose, else where the pose points put it.
// Throws InputError where the rig has neither.
CameraView true_view(const Rig& rig);

// Renders shots one by one; patches, pixels and light of an object are shared by
// its shots. Rig and scenes must outlive it. Not for several threads at once (it uses all of them).
class ShotRenderer {
 public:
  // Throws InputError where the rig lacks a truth material or pose, or for a probe.
  ShotRenderer(const Rig& rig, const ObjectScenes& scenes, const RenderTransport& transport = {});

  // Throws InputError when the object is out of view. The rectangle is the object's; with a board
  // in the shots, the frame.
  RadiancePicture render(const SceneShot& shot);
  // The same light on the object's rectangle, whatever filter a pixel has and without a board.
  ColourRadiance render_colour(const SceneShot& shot);

  // Monte Carlo error of the shots rendered so far: the largest, over shots, lights and channels,
  // of the median relative deviation of a patch's light. 0 for the dipole.
  double monte_carlo_std() const { return monte_carlo_std_; }

  int channel(int x, int y) const { return channel_of_phase_[cfa_phase(x, y)]; }

 private:
  // An object from the camera, with the light of each LED (one) or environment (R, G, B) on it.
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
  SurfaceField volume_field(const SceneShot& shot, Stage& s);

  const Rig& rig_;
  const ObjectScenes& scenes_;
  RenderTransport transport_;
  std::uint64_t runs_ = 0;  // of the Monte Carlo; each has a seed of its own
  double monte_carlo_std_ = 0;
  CameraView view_;
  std::array<int, 4> channel_of_phase_{};
  std::map<std::string, Stage> stages_;
};

}  // namespace scattermeter::apps
