#include "apps/estimation_task.h"

#include <algorithm>
#include <limits>

#include <fmt/core.h>
#include <oneapi/tbb/parallel_for.h>

#include "apps/progress.h"
#include "core/input_error.h"
#include "core/numerics.h"
#include "core/row_selection.h"

namespace scattermeter::apps {
namespace {

// A shot whose brightest patch does not stand out of the noise by this many deviations is dark.
constexpr double kDarkSnr = 10.0;
// A shot with more than this share of its patches clipped is over-exposed as a whole.
constexpr double kClippedShare = 0.5;

// Error of the predicted l of a row while the material is not known.
constexpr double kFirstNumericalStd = 5e-4;

// About the mirror direction of a light: as wide as the gloss of a satin surface.
constexpr double kMirrorConeRad = 0.17;

}  // namespace

std::vector<Task> tasks_of(const Rig& rig, const std::vector<OpenedShot>& shots,
                           const std::string& channels) {
  std::vector<Task> tasks;
  for (const std::string& material : rig.materials()) {
    for (std::size_t c = 0; c < kRgb; ++c) {
      if (!channels.empty() && channels.find(kRgbName[c]) == std::string::npos) continue;
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
      if (!task.shots.empty()) tasks.push_back(task);
    }
  }
  return tasks;
}

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

void add_weights(const std::vector<OpenedShot>& shots, ObjectLibrary& library, bool quiet,
                 const std::function<WeightMatrix(const SeenObject&, const SourceCloud&)>& make,
                 Weights& weights) {
  std::vector<WeightKey> keys;
  for (const OpenedShot& shot : shots) {
    for (const std::string& light : shot.rig->lights) {
      for (std::size_t c = 0; c < library.channels(light); ++c) {
        const WeightKey key{shot.seen.get(), light, c};
        const bool is_new =
            !weights.contains(key) && std::find(keys.begin(), keys.end(), key) == keys.end();
        if (is_new) keys.push_back(key);
      }
    }
  }
  std::vector<const IncidentLight*> lights;
  for (const WeightKey& key : keys) {
    const auto& [view, name, channel] = key;
    lights.push_back(&library.light(view->object->rig->name, name, channel));
    weights[key];
  }
  Progress progress("light in each patch", static_cast<int>(keys.size()), quiet);
  tbb::parallel_for(std::size_t{0}, keys.size(), [&](std::size_t k) {
    const SeenObject& seen = *std::get<0>(keys[k]);
    weights.at(keys[k]) = make(seen, SourceCloud(*lights[k], seen.object->box.center_mm()));
    progress.step();
  });
}

TaskRows rows_of(const Rig& rig, const Task& task) {
  TaskRows rows;
  for (const OpenedShot* shot : task.shots) {
    const SeenObject& seen = *shot->seen;
    ChannelObservation& o = rows.emplace_back(shot->observation.channel[task.channel]);
    for (const std::string& name : shot->rig->lights) {
      const RigLight& light = rig.light(name);
      if (light.environment) continue;
      for (std::size_t j = 0; j < o.l.size(); ++j) {
        if (mirrors(seen.sites[j].center_mm, seen.patches->normal(seen.map.patch_of_row[j]),
                    seen.camera_center_mm, light.led.position_mm, kMirrorConeRad)) {
          leave_out(o, j, RowState::kMirror);
        }
      }
    }
  }
  return rows;
}

ScalePrior scale_prior(const Rig& rig) {
  if (!rig.camera.responsivity) return {std::numeric_limits<double>::infinity()};
  return {rig.camera.responsivity_relative_std};
}

double patch_size_mm(const Task& task) {
  double size_mm = 0.0;
  for (const OpenedShot* shot : task.shots) {
    size_mm = std::max(size_mm, shot->seen->patches->patch_size_mm());
  }
  return size_mm;
}

namespace {

LinearShot linear_shot(const Rig& rig, const Task& task, std::size_t shot_idx,
                       const ChannelObservation& rows, const Weights& weights,
                       double mean_free_path_mm, std::optional<double> patch_mm) {
  const OpenedShot* shot = task.shots[shot_idx];
  LinearShot linear{{}, &rows, kFirstNumericalStd};
  if (mean_free_path_mm > 0.0) {
    linear.numerical_relative_std =
        row_numerics(patch_mm.value_or(shot->seen->patches->patch_size_mm()), mean_free_path_mm);
  }
  for (const std::string& light : shot->rig->lights) {
    const std::size_t own = rig.light(light).colours_differ() ? task.channel : 0;
    linear.lights.push_back({&weights.at({shot->seen.get(), light, own}),
                             rig.light(light).power()[static_cast<Eigen::Index>(task.channel)]});
  }
  return linear;
}

}  // namespace

DenseSystem system_of(const Rig& rig, const Task& task, std::size_t shot,
                      const ChannelObservation& rows, const Weights& weights,
                      double mean_free_path_mm, std::optional<double> patch_mm) {
  return stack({linear_shot(rig, task, shot, rows, weights, mean_free_path_mm, patch_mm)});
}

DenseSystem system_of(const Rig& rig, const Task& task, const TaskRows& rows,
                      const Weights& weights, double mean_free_path_mm) {
  std::vector<LinearShot> shots;
  for (std::size_t i = 0; i < task.shots.size(); ++i) {
    shots.push_back(linear_shot(rig, task, i, rows[i], weights, mean_free_path_mm, std::nullopt));
  }
  return stack(shots);
}

void report_rows(const Task& task, const TaskRows& rows, ChannelResult& result) {
  result.patches_by_state.fill(0);
  result.patches_partly_seen = 0;
  for (const ChannelObservation& o : rows) {
    for (RowState state : o.state) ++result.patches_by_state[static_cast<std::size_t>(state)];
  }
  for (const OpenedShot* shot : task.shots) {
    result.patches_partly_seen += shot->seen->map.patches_partly_seen;
  }
}

std::vector<ShotRows> shot_rows(const Task& task, const TaskRows& rows,
                                const Eigen::VectorXd& predicted, const Eigen::VectorXd& std) {
  std::vector<ShotRows> out;
  Eigen::Index at = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const ChannelObservation& o = rows[i];
    const OpenedShot& shot = *task.shots[i];
    ShotRows& r = out.emplace_back();
    r.file = shot.rig->file;
    r.map = {shot.seen, &shot.seen->map};
    r.observed.assign(o.l.begin(), o.l.end());
    r.state = o.state;
    r.predicted.assign(o.l.size(), std::numeric_limits<float>::quiet_NaN());
    r.std = r.predicted;
    for (std::size_t j = 0; j < o.l.size(); ++j) {
      if (o.state[j] != RowState::kUsed) continue;
      r.predicted[j] = static_cast<float>(predicted[at]);
      r.std[j] = static_cast<float>(std[at]);
      ++at;
    }
  }
  return out;
}

DistanceKnots smooth_knots(const ObjectLibrary& library) {
  return {library.smallest_patch_mm() / 16.0, library.longest_distance_mm()};
}

void add_smooth_weights(const std::vector<OpenedShot>& shots, ObjectLibrary& library, bool quiet,
                        Weights& weights) {
  const DistanceKnots knots = smooth_knots(library);
  const PairSumOptions pairs = pair_options(knots);
  add_weights(
      shots, library, quiet,
      [&](const SeenObject& seen, const SourceCloud& sources) {
        return smooth_weights(seen.sites, sources, knots, pairs);
      },
      weights);
}

PairSumOptions pair_options(const DistanceKnots& knots) {
  PairSumOptions options;
  // The shortest mean free path that is answered for is five resolutions (fit_dipole); a fifth of
  // that keeps the near integral below 1e-5.
  options.floor_mm = knots.resolution_mm();
  return options;
}

void for_open_tasks(const std::string& label, const Estimation& e,
                    const std::function<void(std::size_t)>& work) {
  Progress progress(label, static_cast<int>(e.tasks.size()), e.options.quiet);
  tbb::parallel_for(std::size_t{0}, e.tasks.size(), [&](std::size_t i) {
    if (!e.results[i].refused()) work(i);
    progress.step();
  });
}

}  // namespace scattermeter::apps
