#include "apps/shot_system.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/core.h>
#include <oneapi/tbb/parallel_for.h>

#include "apps/progress.h"
#include "apps/shot_cache.h"
#include "apps/shot_key.h"
#include "apps/shot_pose.h"
#include "core/environment_light.h"
#include "core/input_error.h"

namespace scattermeter::apps {
namespace {

// Precondition: require_in_view() accepts the object.
std::shared_ptr<const SeenObject> see(const Rig& rig, const ObjectScenes& scenes,
                                      const ObjectLibrary& library, const std::string& name,
                                      const calib::PoseResult& pose) {
  const CameraView view{rig.camera.intrinsics, pose.camera_from_world};
  auto seen = std::make_shared<SeenObject>();
  seen->object = &scenes.at(name);
  seen->patches = &library.patches(name);
  seen->camera_center_mm = view.center_in_world_mm();
  const SampleMapOptions options;
  const RayGrid rays = rays_around(view, seen->object->mesh(), 2 * options.guard_px);
  seen->map = map_samples(rays, *seen->object->rays, *seen->patches,
                          seen->object->rig->eta_int_over_ext, options);
  for (std::size_t row = 0; row < seen->map.patch_of_row.size(); ++row) {
    seen->sites.push_back(exit_samples(*seen->patches, seen->map.patch_of_row[row],
                                       seen->map.mean_mm[row], seen->map.spread_mm2[row]));
  }
  return seen;
}

}  // namespace

ObjectLibrary::ObjectLibrary(const Rig& rig, const ObjectScenes& scenes,
                             std::optional<double> patch_size_mm, double distance_to_camera_mm)
    : rig_(rig), scenes_(scenes), probes_(open_probes(rig)) {
  for (const auto& [name, scene] : scenes) {
    // Fewer than about six samples across a patch, and its mean says where they fell, not what it
    // is.
    const double samples_mm = 8.0 * distance_to_camera_mm / rig.camera.intrinsics.fx_px;
    const double chosen_mm = std::max(scene.size_mm() / 50.0, samples_mm);
    const double size_mm = patch_size_mm.value_or(scene.rig->patch_size_mm.value_or(chosen_mm));
    try {
      patches_[name] = std::make_unique<PatchMesh>(scene.mesh(), size_mm);
    } catch (const std::length_error& e) {
      throw InputError(rig.at(scene.rig->line) + ": objects." + name + ".patch_size_mm", e.what());
    }
  }
}

std::size_t ObjectLibrary::channels(const std::string& light) const {
  return rig_.light(light).colours_differ() ? 3 : 1;
}

const IncidentLight& ObjectLibrary::light(const std::string& object, const std::string& light,
                                          std::size_t channel) {
  const RigLight& rig_light = rig_.light(light);
  const ObjectScene& scene = scenes_.at(object);
  if (rig_light.is_ambient) {
    // A small, smooth addition: coarse patches do.
    constexpr double kPatches = 24.0;  // across the object
    return environment_light(object, light, 0, PatchMesh(scene.mesh(), scene.size_mm() / kPatches),
                             scene.rig->eta_int_over_ext);
  }
  if (rig_light.environment) {
    return environment_light(object, light, channel, patches(object), scene.rig->eta_int_over_ext);
  }
  const auto [it, is_new] = leds_.try_emplace({object, light});
  if (is_new) {
    it->second =
        illuminate(patches(object), *scene.rays, rig_light.led, scene.rig->eta_int_over_ext);
    if (it->second.lit.empty()) {
      throw InputError(
          rig_.at(rig_light.line) + ": lights." + light,
          "the LED shines on no part of object " + object + " (look at position_mm and axis)");
    }
  }
  return it->second;
}

const IncidentLight& ObjectLibrary::environment_light(const std::string& object,
                                                      const std::string& light, std::size_t channel,
                                                      const PatchMesh& patches,
                                                      double eta_int_over_ext) {
  const auto [it, is_new] =
      environments_.try_emplace({object, light, patches.patch_size_mm(), eta_int_over_ext});
  if (is_new) {
    EnvironmentLightOptions options;
    if (rig_.light(light).is_ambient) {
      options.tolerance = 3e-4;
      options.sky_bisections = 3;
    }
    it->second =
        illuminate(patches, *scenes_.at(object).rays, probes_.at(light), eta_int_over_ext, options);
  }
  return it->second[channel];
}

std::vector<const IncidentLight*> ObjectLibrary::lights_so_far() const {
  std::vector<const IncidentLight*> out;
  for (const auto& [key, light] : leds_) out.push_back(&light);
  for (const auto& [key, channels] : environments_) {
    for (const IncidentLight& light : channels) out.push_back(&light);
  }
  return out;
}

double ObjectLibrary::smallest_patch_mm() const {
  double smallest = patches_.begin()->second->patch_size_mm();
  for (const auto& [name, patches] : patches_)
    smallest = std::min(smallest, patches->patch_size_mm());
  return smallest;
}

double ObjectLibrary::longest_distance_mm() const {
  double longest = 0.0;
  for (const auto& [name, scene] : scenes_) longest = std::max(longest, scene.diagonal_mm());
  return longest;
}

SharedView see_all(const Rig& rig, const ObjectScenes& scenes, const ObjectLibrary& library,
                   const calib::PoseResult& pose) {
  SharedView view{pose, {}};
  std::vector<std::pair<const std::string*, std::shared_ptr<const SeenObject>*>> objects;
  for (const auto& [name, scene] : scenes) {
    require_in_view(rig, scenes, {rig.camera.intrinsics, pose.camera_from_world}, name);
    objects.push_back({&name, &view.objects[name]});
  }
  tbb::parallel_for(std::size_t{0}, objects.size(), [&](std::size_t i) {
    *objects[i].second = see(rig, scenes, library, *objects[i].first, pose);
  });
  return view;
}

std::vector<capture::RawFrame> frames_of(const RigShot& shot, std::size_t shot_idx,
                                         const FrameSource& frames) {
  std::vector<capture::RawFrame> out;
  for (std::size_t k = 0; k <= shot.more_files.size(); ++k) out.push_back(frames(shot_idx, k));
  return out;
}

std::vector<OpenedShot> open_shots(const Rig& rig, const ShotSource& source,
                                   const ObjectScenes& scenes, const ObjectLibrary& library,
                                   const std::optional<SharedView>& shared, bool quiet) {
  const FrameSource* frames = std::get_if<FrameSource>(&source.open);
  if (!shared && frames == nullptr) {
    throw std::invalid_argument("open_shots: samples without a pose from the rig's points");
  }
  // A free scale works in units of its own: counts per second.
  const std::array<double, 3> responsivity =
      rig.camera.responsivity.value_or(std::array<double, 3>{1.0, 1.0, 1.0});
  // Where each shot's own silhouette starts from, without a board.
  std::optional<calib::PoseResult> points;
  if (!shared && !rig.pose.charuco) points = pose_from_points(rig);
  std::vector<OpenedShot> shots(source.shot_idxs.size());
  Progress progress("reading shots", static_cast<int>(shots.size()), quiet);
  tbb::parallel_for(std::size_t{0}, shots.size(), [&](std::size_t i) {
    OpenedShot& shot = shots[i];
    const std::size_t idx = source.shot_idxs[i];
    shot.rig = &rig.shots.at(idx);
    if (shared) {
      shot.pose = shared->pose;
      shot.seen = shared->objects.at(shot.rig->object);
    }
    const bool may_be_kept = source.cache != nullptr && shared && frames != nullptr;
    std::string key;
    if (may_be_kept) {
      key = shot_key(rig, shot, source.names.at(i), *source.digests);
      if (std::optional<DecodedShot> kept = source.cache->find(key);
          kept && kept->observation.channel[0].l.size() == shot.seen->map.patch_of_row.size()) {
        static_cast<DecodedShot&>(shot) = std::move(*kept);
        progress.step();
        return;
      }
    }
    CfaSamples samples;
    if (frames != nullptr) {
      const std::vector<capture::RawFrame> exposures = frames_of(*shot.rig, idx, *frames);
      const capture::RawFrame& frame = exposures.front();
      const std::vector<std::string>& names = source.names.at(i);
      shot.iso = frame.iso;
      shot.f_number = frame.f_number;
      if (!shared) {
        shot.pose = points ? *points : pose_from_board(rig, frame, names.at(0));
        if (rig.pose.refine_by_silhouette) {
          shot.pose = pose_from_silhouette(rig, scenes, shot.pose, idx, frame, names.at(0));
        }
        require_in_view(rig, scenes, {rig.camera.intrinsics, shot.pose.camera_from_world},
                        shot.rig->object);
        shot.seen = see(rig, scenes, library, shot.rig->object, shot.pose);
      }
      const SampleMap& map = shot.seen->map;
      ShotSamples of_shot =
          shot_samples(rig, *shot.rig, exposures, names, map.x0, map.y0, map.width, map.height);
      for (const capture::RawFrame& f : exposures) {
        shot.samples_outside += f.samples.size() - static_cast<std::size_t>(map.width) *
                                                       static_cast<std::size_t>(map.height);
      }
      shot.exposures = std::move(of_shot.exposures);
      shot.frame_mean_counts = of_shot.frame_mean_counts;
      samples = std::move(of_shot.samples);
    } else {
      shot.iso = rig.camera.iso;
      shot.f_number = rig.camera.f_number;
      samples = std::get<SampleSource>(source.open)(idx, shot.seen->map);
    }
    shot.exposure_s = samples.exposure_s;
    shot.observation = observe(samples, shot.seen->map, responsivity);
    if (may_be_kept) source.cache->keep(key, shot);
    progress.step();
  });
  return shots;
}

}  // namespace scattermeter::apps
