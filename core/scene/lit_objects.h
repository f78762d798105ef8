// Patches and light of a scene's objects, shared by its shots.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "core/light/incident_light.h"
#include "core/mesh/patch_mesh.h"
#include "core/scene/object_scene.h"
#include "core/scene/scene.h"

namespace scattermeter {

class LitObjects {
 public:
  // Opens the lights that shots refer to. patch_size_mm: for every object; by default the scene's;
  // failing that, object size / 50, but at least eight samples at this distance from the camera (0:
  // unknown). Scene and objects must outlive it. Throws InputError for a light that cannot be read
  // and for patches that are too small.
  LitObjects(const Scene& scene, const ObjectScenes& objects, std::optional<double> patch_size_mm,
             double distance_to_camera_mm);

  const PatchMesh& patches(const std::string& object) const { return *patches_.at(object); }
  // c_k of one light on one object, for a channel 0 .. channels() - 1 of the light; computed on the
  // first call. Throws InputError when an LED illuminates no part of the object. Not thread-safe.
  const IncidentLight& light(const std::string& object, const std::string& name,
                             std::size_t channel);
  // Whether light() would throw for the LED instead.
  bool reaches(const std::string& object, const std::string& name, std::size_t channel);
  // As light(), on other patches of the object or for another eta; cached as well.
  const IncidentLight& light_on(const std::string& object, const SceneLight& light,
                                std::size_t channel, const PatchMesh& patches,
                                double eta_int_over_ext);
  // All lights computed so far.
  std::vector<const IncidentLight*> lights_so_far() const;
  double smallest_patch_mm() const;
  double longest_distance_mm() const;

 private:
  const IncidentLight& light_on_patches(const std::string& object, const SceneLight& light,
                                        std::size_t channel);

  const Scene& scene_;
  const ObjectScenes& objects_;
  std::map<std::string, std::unique_ptr<PatchMesh>> patches_;
  // By object, light, patch size, eta; by channel of the light.
  std::map<std::tuple<std::string, std::string, double, double>, std::vector<IncidentLight>>
      lights_;
};

// The patches on which a light is computed: the object's, or, for smooth light, coarser ones, which
// are then stored in `coarse`.
const PatchMesh& patches_for(const Light& light, LightUse use, const ObjectScene& object,
                             const PatchMesh& patches, std::optional<PatchMesh>& coarse);

}  // namespace scattermeter
