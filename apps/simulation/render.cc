#include "apps/simulation/render.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "apps/rig/open_objects.h"
#include "core/base/input_error.h"
#include "core/base/nearest_name.h"
#include "core/base/progress.h"

namespace scattermeter::apps {
namespace {

template <typename Named>
void require_known(const Rig& rig, const std::vector<Named>& known, const std::string& name,
                   const std::string& kind) {
  std::string all;
  std::vector<std::string> names;
  for (const Named& k : known) {
    if (k.name == name) return;
    all += (all.empty() ? "" : ", ") + k.name;
    names.push_back(k.name);
  }
  throw InputError(rig.path,
                   "has no " + kind + " " + name + ", only " + all + did_you_mean(name, names));
}

std::vector<RenderScene> scenes_of(const Rig& rig, const RenderOptions& options) {
  for (const std::string& name : options.objects)
    require_known(rig, rig.scene.objects, name, "object");
  for (const std::string& name : options.lights)
    require_known(rig, rig.scene.lights, name, "light");
  std::vector<RenderScene> scenes;
  const auto add = [&](const std::string& object, const std::vector<std::string>& lights) {
    const bool there = std::any_of(scenes.begin(), scenes.end(), [&](const RenderScene& s) {
      return s.object == object && s.lights == lights;
    });
    if (!there) scenes.push_back({object, lights});
  };
  for (const SceneShot& shot : rig.scene.shots) {
    if (!options.objects.empty() && std::find(options.objects.begin(), options.objects.end(),
                                              shot.object) == options.objects.end()) {
      continue;
    }
    add(shot.object, options.lights.empty() ? shot.lights : options.lights);
  }
  // Requested objects that are in no shot.
  for (const std::string& object : options.objects) {
    const bool there = std::any_of(scenes.begin(), scenes.end(),
                                   [&](const RenderScene& s) { return s.object == object; });
    if (there) continue;
    if (options.lights.empty()) {
      throw InputError(rig.path, "has no shot of object " + object +
                                     " that names its lights: choose them by --light");
    }
    add(object, options.lights);
  }
  return scenes;
}

// The camera of the rig at another number of pixels for the same frame.
void resize_camera(Rig& rig, int width_px) {
  CameraIntrinsics& k = rig.scene.camera.intrinsics;
  const double scale = static_cast<double>(width_px) / k.width_px;
  k.width_px = width_px;
  k.height_px = std::max(1, static_cast<int>(std::lround(scale * k.height_px)));
  k.fx_px *= scale;
  k.fy_px *= scale;
  // The centre of pixel 0 is half a pixel from the edge of the frame.
  k.cx_px = (k.cx_px + 0.5) * scale - 0.5;
  k.cy_px = (k.cy_px + 0.5) * scale - 0.5;
}

// Returns the name of the object with this eta, which it adds to the rig if necessary.
std::string object_with_eta(Rig& rig, const std::string& name, double eta) {
  if (rig.scene.object(name).eta_int_over_ext == eta) return name;
  const std::string copy_name = fmt::format("{} (eta {})", name, eta);
  const bool there = std::any_of(rig.scene.objects.begin(), rig.scene.objects.end(),
                                 [&](const SceneObject& o) { return o.name == copy_name; });
  if (!there) {
    SceneObject copy = rig.scene.object(name);
    copy.name = copy_name;
    copy.eta_int_over_ext = eta;
    rig.scene.objects.push_back(copy);
  }
  return copy_name;
}

}  // namespace

Rendering render(const Rig& given, const std::vector<MeasuredMaterial>& materials,
                 const RenderOptions& options) {
  Rendering out;
  out.scenes = scenes_of(given, options);
  Rig rig = given;
  const CameraView view = true_view(given);
  const Rigid3d world_from_camera = inverse(view.camera_from_world);
  rig.truth.pose = CameraPlacement{world_from_camera.translation_mm,
                                   world_from_camera * Eigen::Vector3d(0, 0, 1),
                                   world_from_camera.rotation * Eigen::Vector3d(0, -1, 0)};
  rig.pose.charuco.reset();
  if (options.width_px > 0) resize_camera(rig, options.width_px);
  rig.truth.materials.clear();
  rig.scene.shots.clear();
  for (const RenderScene& scene : out.scenes) {
    for (const MeasuredMaterial& m : materials) {
      SceneShot shot;
      shot.file = scene.object + " " + m.name;
      shot.object = object_with_eta(rig, scene.object, m.eta_int_over_ext);
      shot.material = m.name;
      shot.lights = scene.lights;
      rig.scene.shots.push_back(shot);
      for (std::size_t c = 0; c < 3; ++c) {
        rig.truth.materials[m.name][c] = m.rgb[c].medium();
      }
    }
  }
  const ObjectScenes objects = open_objects(rig);
  ShotRenderer renderer(rig, objects, options.transport);
  ProgressStage stage(options.progress, "rendering", rig.scene.shots.size());
  for (std::size_t i = 0; i < rig.scene.shots.size(); ++i) {
    RenderedPicture picture;
    picture.scene_idx = i / materials.size();
    picture.material_idx = i % materials.size();
    picture.radiance = renderer.render_colour(rig.scene.shots[i]);
    picture.monte_carlo_std = renderer.monte_carlo_std();
    out.pictures.push_back(picture);
    stage.step();
  }
  return out;
}

}  // namespace scattermeter::apps
