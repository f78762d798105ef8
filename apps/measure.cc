#include "apps/measure.h"

#include <algorithm>

#include <oneapi/tbb/parallel_for.h>

#include "apps/estimation_task.h"
#include "apps/file_digest.h"
#include "apps/shot_folder.h"
#include "apps/shot_pose.h"
#include "apps/stopwatch.h"

namespace scattermeter::apps {
namespace {

void list_inputs(const Rig& rig, const ObjectScenes& scenes, const std::vector<std::string>& paths,
                 Measurement& out) {
  std::vector<std::string> files = {rig.path};
  for (const auto& [name, scene] : scenes) {
    if (std::find(files.begin(), files.end(), scene.rig->mesh_path) == files.end()) {
      files.push_back(scene.rig->mesh_path);
    }
  }
  for (const RigShot& shot : rig.shots) {
    for (const std::string& name : shot.lights) {
      const RigLight& light = rig.light(name);
      if (light.environment &&
          std::find(files.begin(), files.end(), light.environment->image_path) == files.end()) {
        files.push_back(light.environment->image_path);
      }
    }
  }
  files.insert(files.end(), paths.begin(), paths.end());
  out.inputs.resize(files.size());
  tbb::parallel_for(std::size_t{0}, files.size(), [&](std::size_t i) {
    out.inputs[i] = {files[i], sha256_of_file(files[i])};
  });
}

}  // namespace

bool Measurement::any_refused() const {
  return std::any_of(results.begin(), results.end(),
                     [](const ChannelResult& r) { return r.refused(); });
}

const char* model_name(Model model) { return model == Model::kPaper ? "paper" : "dipole"; }

Measurement measure(const Rig& rig, const std::string& shots_folder,
                    const MeasureOptions& options) {
  Measurement out;
  out.model = options.model;
  Stopwatch watch(out.timing_s);
  const ShotFolder folder = match_shots(rig, shots_folder);
  for (const std::string& name : folder.unlisted) {
    out.notes.push_back(name + ": not in the rig's list of shots, skipped");
  }
  const ObjectScenes scenes = open_objects(rig);
  std::optional<calib::PoseResult> shared_pose;
  double distance_mm = 0.0;
  if (!rig.pose.charuco) {
    shared_pose = pose_from_points(rig);
    const CameraView view{rig.camera.intrinsics, shared_pose->camera_from_world};
    for (const auto& [name, scene] : scenes) {
      distance_mm =
          std::max(distance_mm, (view.center_in_world_mm() - scene.box.center_mm()).norm());
    }
  }
  ObjectLibrary library(rig, scenes, options.patch_size_mm, distance_mm);
  for (const auto& [name, scene] : scenes) {
    out.patch_size_mm[name] = library.patches(name).patch_size_mm();
  }
  watch.lap("geometry");
  const std::vector<OpenedShot> shots =
      open_shots(rig, folder.paths, scenes, library, shared_pose, options.quiet);
  watch.lap("shots");
  const std::vector<Task> tasks = tasks_of(rig, shots);
  for (const Task& task : tasks) {
    ChannelResult result{task.material, kRgbName[task.channel], task.eta, {}, {}};
    for (const OpenedShot* shot : task.shots) {
      result.shots.push_back(shot->rig->file);
      if (const std::string problem = shot_problem(*shot, task.channel); !problem.empty()) {
        result.estimate.reasons.push_back(problem);
      }
    }
    out.results.push_back(result);
  }
  Estimation estimation{rig, shots, tasks, library, options, watch, out.results};
  if (options.model == Model::kPaper) {
    estimate_paper(estimation);
  } else {
    estimate_dipole(estimation);
  }
  list_inputs(rig, scenes, folder.paths, out);
  watch.lap("digests");
  watch.total();
  return out;
}

}  // namespace scattermeter::apps
