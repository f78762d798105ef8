// Radiance of a rig's shots.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "apps/camera_view.h"
#include "apps/object_scene.h"
#include "apps/rig.h"
#include "apps/rig_probes.h"
#include "core/cfa_samples.h"
#include "core/dipole_image.h"
#include "core/incident_light.h"
#include "core/patch_mesh.h"
#include "core/shade_map.h"

namespace scattermeter::apps {

// Radiance, W/(mm^2 sr), each pixel in the channel of its own filter.
struct RadiancePicture {
  int x0 = 0, y0 = 0, width = 0, height = 0;  // px, in the frame
  std::vector<float> radiance;                // row by row
  // At normal exit of the brightest place of the object, per channel: an upper bound for its
  // pixels.
  Eigen::Array3d brightest = Eigen::Array3d::Zero();
};

// Renders shots one by one, with the dipole; patches, pixels and light of an object are shared by
// its shots. Rig and scenes must outlive it. Not for several threads at once (it uses all of them).
class ShotRenderer {
 public:
  // Throws InputError where the rig lacks a truth material or pose, or for a probe.
  ShotRenderer(const Rig& rig, const ObjectScenes& scenes);

  // Throws InputError when the object is out of view. The rectangle is the object's; with a board
  // in the shots, the frame.
  RadiancePicture render(const RigShot& shot);

  int channel(int x, int y) const { return channel_of_phase_[cfa_phase(x, y)]; }

 private:
  // An object from the camera, with the light of each LED (one) or environment (R, G, B) on it.
  struct Stage {
    std::unique_ptr<PatchMesh> patches;
    std::unique_ptr<ShadeMap> pixels;
    std::vector<bool> needed;
    std::map<std::string, std::vector<IncidentLight>> lights;
  };
  Stage& stage(const std::string& object);
  std::vector<IncidentLight> light_on(const RigLight& light, const ObjectScene& scene,
                                      const PatchMesh& patches) const;
  SurfaceField field(const RigShot& shot, Stage& s) const;

  const Rig& rig_;
  const ObjectScenes& scenes_;
  RigProbes probes_;
  CameraView view_;
  std::array<int, 4> channel_of_phase_{};
  std::map<std::string, Stage> stages_;
};

}  // namespace scattermeter::apps
