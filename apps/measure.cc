#include "apps/measure.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <memory>

#include <fmt/core.h>
#include <oneapi/tbb/parallel_for.h>

#include "apps/file_digest.h"
#include "apps/progress.h"
#include "apps/shot_folder.h"
#include "apps/shot_pose.h"
#include "apps/shot_system.h"
#include "core/dipole_fit.h"
#include "core/input_error.h"
#include "core/linear_shot.h"
#include "core/paper_estimator.h"

namespace scattermeter::apps {
namespace {

// A shot whose brightest patch does not stand out of the noise by this many deviations is dark.
constexpr double kDarkSnr = 10.0;
// A shot with more than this share of its patches clipped is over-exposed as a whole.
constexpr double kClippedShare = 0.5;

class Stopwatch {
 public:
  explicit Stopwatch(Measurement& measurement) : measurement_(measurement) {}
  void lap(const char* stage) {
    const auto now = std::chrono::steady_clock::now();
    measurement_.timing_s.emplace_back(stage, seconds(last_, now));
    last_ = now;
  }
  void total() {
    measurement_.timing_s.emplace_back("total", seconds(start_, std::chrono::steady_clock::now()));
  }

 private:
  using Time = std::chrono::steady_clock::time_point;
  static double seconds(Time a, Time b) { return std::chrono::duration<double>(b - a).count(); }
  Measurement& measurement_;
  Time start_ = std::chrono::steady_clock::now();
  Time last_ = start_;
};

// Shots of one material and channel, before any weights.
struct Task {
  std::string material;
  std::size_t channel;
  std::vector<const OpenedShot*> shots;
  double eta = 0;
};

std::vector<Task> tasks_of(const Rig& rig, const std::vector<OpenedShot>& shots) {
  std::vector<Task> tasks;
  for (const std::string& material : rig.materials()) {
    for (std::size_t c = 0; c < kRgb; ++c) {
      Task task{material, c, {}, 0.0};
      for (const OpenedShot& shot : shots) {
        if (shot.rig->material != material) continue;
        const double eta = shot.seen->object->rig->eta_int_over_ext;
        if (!task.shots.empty() && eta != task.eta) {
          throw InputError(rig.at(shot.rig->line) + ": shots.object",
                           fmt::format("material {} has eta {} here but {} in another shot",
                                       material, eta, task.eta));
        }
        task.eta = eta;
        task.shots.push_back(&shot);
      }
      tasks.push_back(task);
    }
  }
  return tasks;
}

// What makes a shot useless as a whole in a channel; empty: nothing.
std::string shot_problem(const OpenedShot& shot, std::size_t channel) {
  const ChannelObservation& o = shot.observation.channel[channel];
  const char name = kRgbName[channel];
  const double rows = static_cast<double>(o.l.size());
  if (o.l.empty()) return fmt::format("{}: no whole patch of the object is seen", shot.rig->file);
  if (static_cast<double>(o.rows_clipped) > kClippedShare * rows) {
    return fmt::format("{}: channel {} is clipped on {:.0f} % of the object (exposure {:g} s)",
                       shot.rig->file, name, 100.0 * static_cast<double>(o.rows_clipped) / rows,
                       shot.exposure_s);
  }
  if (o.brightest_snr < kDarkSnr) {
    return fmt::format("{}: channel {} is dark, brightest patch {:.1f} counts above black",
                       shot.rig->file, name, o.brightest_counts);
  }
  return "";
}

// Weights by (view of an object, light).
using WeightKey = std::pair<const SeenObject*, std::string>;
using Weights = std::map<WeightKey, WeightMatrix>;

template <class MakeWeights>
Weights all_weights(const std::vector<OpenedShot>& shots, ObjectLibrary& library, bool quiet,
                    const MakeWeights& make) {
  std::vector<WeightKey> keys;
  for (const OpenedShot& shot : shots) {
    for (const std::string& light : shot.rig->lights) {
      const WeightKey key{shot.seen.get(), light};
      if (std::find(keys.begin(), keys.end(), key) == keys.end()) keys.push_back(key);
    }
  }
  Weights weights;
  Progress progress("light in each patch", static_cast<int>(keys.size()), quiet);
  for (const WeightKey& key : keys) {
    const SeenObject& seen = *key.first;
    const IncidentLight& light = library.light(seen.object->rig->name, key.second);
    weights[key] = make(seen, SourceCloud(light, seen.object->box.center_mm()));
    progress.step();
  }
  return weights;
}

DenseSystem system_of(const Rig& rig, const Task& task, const Weights& weights) {
  std::vector<LinearShot> shots;
  for (const OpenedShot* shot : task.shots) {
    LinearShot linear{{}, &shot->observation.channel[task.channel]};
    for (const std::string& light : shot->rig->lights) {
      linear.lights.push_back(
          {&weights.at({shot->seen.get(), light}),
           rig.light(light).led.intensity_W_per_sr[static_cast<Eigen::Index>(task.channel)]});
    }
    shots.push_back(linear);
  }
  return stack(shots);
}

PairSumOptions pair_options(const DistanceKnots& knots) {
  PairSumOptions options;
  // The shortest mean free path that is answered for is two resolutions (fit_dipole); half of that
  // keeps the near integral below 1e-5.
  options.floor_mm = knots.resolution_mm();
  return options;
}

void estimate_dipole(const Rig& rig, const std::vector<OpenedShot>& shots,
                     const std::vector<Task>& tasks, ObjectLibrary& library,
                     const MeasureOptions& options, Stopwatch& watch, Measurement& out) {
  const DistanceKnots knots(library.smallest_patch_mm() / 16.0, library.longest_distance_mm());
  const PairSumOptions pairs = pair_options(knots);
  const Weights weights = all_weights(shots, library, options.quiet,
                                      [&](const SeenObject& seen, const SourceCloud& sources) {
                                        return smooth_weights(seen.sites, sources, knots, pairs);
                                      });
  watch.lap("light");
  Progress progress("fitting", static_cast<int>(tasks.size()), options.quiet);
  tbb::parallel_for(std::size_t{0}, tasks.size(), [&](std::size_t i) {
    if (!out.results[i].refused()) {
      DipoleFitOptions fit;
      fit.eta_int_over_ext = tasks[i].eta;
      fit.scale.relative_std = rig.camera.responsivity ? rig.camera.responsivity_relative_std
                                                       : std::numeric_limits<double>::infinity();
      out.results[i].estimate = fit_dipole(system_of(rig, tasks[i], weights), knots, fit);
    }
    progress.step();
  });
  watch.lap("fit");
}

void estimate_paper(const Rig& rig, const std::vector<OpenedShot>& shots,
                    const std::vector<Task>& tasks, ObjectLibrary& library,
                    const MeasureOptions& options, Stopwatch& watch, Measurement& out) {
  const DistanceKnots knots(library.smallest_patch_mm() / 16.0, library.longest_distance_mm());
  std::vector<std::vector<PaperAnswer>> answers(tasks.size());
  const std::vector<double> widths = paper_widths_mm();
  for (std::size_t w = 0; w < widths.size(); ++w) {
    const UniformBins bins(widths[w], library.longest_distance_mm());
    const Weights weights =
        all_weights(shots, library, true, [&](const SeenObject& seen, const SourceCloud& sources) {
          return uniform_weights(seen.sites, sources, bins, pair_options(knots));
        });
    Progress progress(fmt::format("width {:.2f} mm", widths[w]), static_cast<int>(tasks.size()),
                      options.quiet);
    tbb::parallel_for(std::size_t{0}, tasks.size(), [&](std::size_t i) {
      if (!out.results[i].refused()) {
        const DenseSystem system = system_of(rig, tasks[i], weights);
        if (system.l.size() > 0) {
          answers[i].push_back(solve_paper(system, widths[w], tasks[i].eta));
        }
      }
      progress.step();
    });
  }
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    if (out.results[i].refused()) continue;
    if (answers[i].empty()) {
      out.results[i].estimate.reasons.push_back("no patch can be used");
    } else {
      out.results[i].estimate = choose_width(answers[i]);
    }
  }
  watch.lap("fit");
}

void list_inputs(const Rig& rig, const ObjectScenes& scenes, const std::vector<std::string>& paths,
                 Measurement& out) {
  std::vector<std::string> files = {rig.path};
  for (const auto& [name, scene] : scenes) {
    if (std::find(files.begin(), files.end(), scene.rig->mesh_path) == files.end()) {
      files.push_back(scene.rig->mesh_path);
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
  Stopwatch watch(out);
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
  if (options.model == Model::kPaper) {
    estimate_paper(rig, shots, tasks, library, options, watch, out);
  } else {
    estimate_dipole(rig, shots, tasks, library, options, watch, out);
  }
  list_inputs(rig, scenes, folder.paths, out);
  watch.lap("digests");
  watch.total();
  return out;
}

}  // namespace scattermeter::apps
