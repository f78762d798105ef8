#include "apps/instrument.h"

#include <algorithm>
#include <exception>
#include <set>

#include <oneapi/tbb/parallel_invoke.h>

#include "apps/shot_pose.h"

namespace scattermeter::apps {
namespace {

std::optional<calib::PoseResult> shared_pose(const Rig& rig) {
  if (rig.pose.charuco) return std::nullopt;
  return pose_from_points(rig);
}

// To the farthest object; 0 where the pose is not known before the shots are.
double distance_to_camera_mm(const Rig& rig, const ObjectScenes& scenes,
                             const std::optional<calib::PoseResult>& pose) {
  if (!pose) return 0.0;
  const CameraView view{rig.camera.intrinsics, pose->camera_from_world};
  double distance_mm = 0.0;
  for (const auto& [name, scene] : scenes) {
    distance_mm = std::max(distance_mm, (view.center_in_world_mm() - scene.box.center_mm()).norm());
  }
  return distance_mm;
}

std::vector<MergedBracket> brackets_of(const std::vector<OpenedShot>& shots) {
  std::vector<MergedBracket> out;
  for (const OpenedShot& shot : shots) {
    if (shot.exposures.size() < 2) continue;
    MergedBracket& bracket = out.emplace_back();
    bracket.shot = shot.rig->file;
    for (std::size_t c = 0; c < kRgb; ++c) {
      bracket.samples[c] = shot.observation.channel[c].samples;
      bracket.samples_clipped[c] = shot.observation.channel[c].samples_clipped;
    }
    for (std::size_t k = 0; k < shot.exposures.size(); ++k) {
      MergedBracket::File& file = bracket.files.emplace_back();
      file.file = shot.exposures[k].file;
      file.exposure_s = shot.exposures[k].true_s;
      file.departure = shot.exposures[k].departure;
      for (std::size_t c = 0; c < kRgb; ++c) {
        file.samples[c] = shot.observation.channel[c].exposures[k].samples;
      }
    }
  }
  return out;
}

Skipped skipped_of(const std::vector<OpenedShot>& shots, const ObjectLibrary& library) {
  Skipped out;
  std::set<const SeenObject*> views;
  for (const OpenedShot& shot : shots) {
    out.samples_outside += shot.samples_outside;
    if (views.insert(shot.seen.get()).second) {
      out.patches_unseen +=
          static_cast<std::size_t>(shot.seen->patches->size()) - shot.seen->map.patch_of_row.size();
    }
  }
  for (const IncidentLight* light : library.lights_so_far()) {
    out.patches_unlit += static_cast<std::size_t>(
        std::count(light->patch_power_sr.begin(), light->patch_power_sr.end(), 0.0));
    out.shadow_rays += light->shadow_rays_skipped;
  }
  return out;
}

// Reads the shots and meanwhile makes W of the views and lights that they need: neither wants the
// other.
std::vector<OpenedShot> open_and_light(const Rig& rig, const ShotSource& source,
                                       const ObjectScenes& scenes, ObjectLibrary& library,
                                       const SharedView& view, bool quiet, Weights& weights) {
  std::vector<OpenedShot> unread(source.shot_idxs.size());
  for (std::size_t i = 0; i < unread.size(); ++i) {
    unread[i].rig = &rig.shots.at(source.shot_idxs[i]);
    unread[i].seen = view.objects.at(unread[i].rig->object);
  }
  std::vector<OpenedShot> shots;
  std::exception_ptr of_light;
  tbb::parallel_invoke([&] { shots = open_shots(rig, source, scenes, library, view, quiet); },
                       [&] {
                         try {
                           add_smooth_weights(unread, library, true, weights);
                         } catch (...) {
                           // What is wrong with a shot is told first.
                           of_light = std::current_exception();
                         }
                       });
  if (of_light) std::rethrow_exception(of_light);
  return shots;
}

}  // namespace

Instrument::Instrument(const Rig& rig, const ObjectScenes& scenes, const MeasureOptions& options)
    : rig_(rig),
      scenes_(scenes),
      options_(options),
      pose_(shared_pose(rig)),
      library_(rig, scenes, options.patch_size_mm, distance_to_camera_mm(rig, scenes, pose_)) {
  if (pose_ && !rig.pose.refine_by_silhouette) view_ = see_all(rig, scenes, library_, *pose_);
}

Measurement Instrument::measure(const ShotSource& source) {
  std::vector<std::pair<std::string, double>> timing_s;
  Stopwatch watch(timing_s);
  Measurement out = measure(source, watch);
  watch.total();
  out.timing_s = timing_s;
  return out;
}

Measurement Instrument::measure(const ShotSource& source, Stopwatch& watch) {
  std::vector<OpenedShot> shots;
  return measure(source, watch, false, shots);
}

Measurement Instrument::forecast(const ShotSource& source, std::vector<OpenedShot>& opened) {
  std::vector<std::pair<std::string, double>> timing_s;
  Stopwatch watch(timing_s);
  return measure(source, watch, true, opened);
}

Measurement Instrument::measure(const ShotSource& source, Stopwatch& watch, bool without_noise,
                                std::vector<OpenedShot>& shots) {
  const Model model = without_noise ? Model::kDipole : options_.model;
  Measurement out;
  out.model = model;
  for (const auto& [name, scene] : scenes_) {
    out.patch_size_mm[name] = library_.patches(name).patch_size_mm();
  }
  if (!view_) {
    // Those of views that are gone.
    weights_.clear();
    changed_weights_.clear();
  }
  std::optional<SharedView> view = view_;
  if (!view && pose_ && !rig_.pose.per_shot) {
    view = see_all(rig_, scenes_, library_, pose_from_silhouettes(rig_, scenes_, *pose_, source));
  }
  shots = view && model != Model::kPaper
              ? open_and_light(rig_, source, scenes_, library_, *view, options_.quiet, weights_)
              : open_shots(rig_, source, scenes_, library_, view, options_.quiet);
  watch.lap("shots");
  out.brackets = brackets_of(shots);
  const std::vector<Task> tasks = tasks_of(rig_, shots, options_.channels);
  for (const Task& task : tasks) {
    ChannelResult result;
    result.material = task.material;
    result.channel = kRgbName[task.channel];
    result.model = model == Model::kAuto ? Model::kDipole : model;
    result.eta_int_over_ext = task.eta;
    for (const OpenedShot* shot : task.shots) {
      result.shots.push_back(shot->rig->file);
      if (const std::string problem = shot_problem(*shot, task.channel); !problem.empty()) {
        result.estimate.reasons.push_back(problem);
      }
    }
    out.results.push_back(result);
  }
  Estimation estimation{rig_,     shots, tasks,       library_,     weights_, changed_weights_,
                        options_, watch, out.results, without_noise};
  if (model == Model::kPaper) {
    estimate_paper(estimation);
  } else if (model != Model::kDipole) {
    estimate_transport(estimation);
  } else {
    estimate_dipole(estimation);
  }
  out.skipped = skipped_of(shots, library_);
  for (const ChannelResult& r : out.results) out.skipped.nuisances += r.nuisances_negligible;
  out.skipped.channels_not_asked = tasks_of(rig_, shots).size() - tasks.size();
  return out;
}

}  // namespace scattermeter::apps
