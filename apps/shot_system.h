// The linear systems of all shots, from frames to W and l.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "apps/camera_view.h"
#include "apps/decoded_shot.h"
#include "apps/object_scene.h"
#include "apps/rig.h"
#include "apps/rig_probes.h"
#include "apps/shot_samples.h"
#include "apps/shot_source.h"
#include "calib/pose.h"
#include "core/distance_weights.h"
#include "core/incident_light.h"
#include "core/observation.h"
#include "core/patch_mesh.h"
#include "core/sample_map.h"

namespace scattermeter::apps {

// An object as one camera pose sees it.
struct SeenObject {
  const ObjectScene* object = nullptr;
  const PatchMesh* patches = nullptr;
  Eigen::Vector3d camera_center_mm = Eigen::Vector3d::Zero();
  SampleMap map;
  std::vector<ExitSite> sites;  // of the map's rows
  // What shadows an LED, where that is more than the object itself (changed_weights()); else null.
  const RayScene* shadows = nullptr;
};

struct OpenedShot : DecodedShot {
  const RigShot* rig = nullptr;
  std::shared_ptr<const SeenObject> seen;
  calib::PoseResult pose;
  std::size_t samples_outside = 0;  // of the frames, in no object's rectangle: not converted
};

// Patches and light of the rig's objects, shared by the shots.
class ObjectLibrary {
 public:
  // patch_size_mm: for every object; else the rig's; else object size / 50, but at least six
  // samples.
  ObjectLibrary(const Rig& rig, const ObjectScenes& scenes, std::optional<double> patch_size_mm,
                double distance_to_camera_mm);

  const PatchMesh& patches(const std::string& object) const { return *patches_.at(object); }
  // Channels that differ in where the light goes: 3 for an environment, 1 for an LED.
  std::size_t channels(const std::string& light) const;
  // c_k of one light on one object, for a channel 0 .. 2 (an LED's channels are one and the same);
  // computed at the first call. Throws InputError when the light reaches no part of the object.
  // Not for several threads at once.
  const IncidentLight& light(const std::string& object, const std::string& light,
                             std::size_t channel);
  // The same on other patches of the object or for another eta, of an environment; kept, too.
  const IncidentLight& environment_light(const std::string& object, const std::string& light,
                                         std::size_t channel, const PatchMesh& patches,
                                         double eta_int_over_ext);
  // Those of LEDs and environments that were computed.
  std::vector<const IncidentLight*> lights_so_far() const;
  double smallest_patch_mm() const;
  double longest_distance_mm() const;

 private:
  const Rig& rig_;
  const ObjectScenes& scenes_;
  std::map<std::string, std::unique_ptr<PatchMesh>> patches_;
  RigProbes probes_;
  std::map<std::pair<std::string, std::string>, IncidentLight> leds_;
  // By object, light, patch size, eta.
  std::map<std::tuple<std::string, std::string, double, double>, std::array<IncidentLight, 3>>
      environments_;
};

// One pose for all shots, and the objects as seen from it.
struct SharedView {
  calib::PoseResult pose;
  std::map<std::string, std::shared_ptr<const SeenObject>> objects;
};

// Throws InputError when an object is out of view.
SharedView see_all(const Rig& rig, const ObjectScenes& scenes, const ObjectLibrary& library,
                   const calib::PoseResult& pose);

// All frames of a shot, in the order of RigShot::files().
std::vector<capture::RawFrame> frames_of(const RigShot& shot, std::size_t shot_idx,
                                         const FrameSource& frames);

// Gets every shot of the source and reduces it to one l per visible patch and channel. With the
// pose of all shots (`shared`), shots of one object share their map; without, each has a pose of
// its own, from a board or its silhouette (a FrameSource, then: std::invalid_argument otherwise).
// With the pose of all shots, too, those that the source's cache holds are not decoded.
std::vector<OpenedShot> open_shots(const Rig& rig, const ShotSource& source,
                                   const ObjectScenes& scenes, const ObjectLibrary& library,
                                   const std::optional<SharedView>& shared, bool quiet);

}  // namespace scattermeter::apps
