#include "apps/instrument/instrument.h"

#include <algorithm>

#include <fmt/core.h>

#include "apps/instrument/fitted_view.h"
#include "apps/instrument/focus.h"
#include "apps/instrument/rig_places.h"
#include "apps/instrument/row_precision.h"
#include "apps/instrument/seen_shots.h"
#include "apps/instrument/shot_summary.h"
#include "apps/looks/closer_look.h"
#include "apps/looks/displaced_round_bodies.h"
#include "apps/looks/first_look.h"
#include "apps/looks/frame_watch.h"
#include "apps/looks/light_look.h"
#include "apps/looks/outline_watch.h"
#include "apps/looks/piece_places.h"
#include "calib/pose/shot_pose.h"
#include "core/base/chi_square.h"
#include "core/base/input_error.h"
#include "core/base/progress.h"

namespace scattermeter::apps {
namespace {

std::optional<PoseResult> shared_pose(const Rig& rig) {
  if (rig.pose.charuco) return std::nullopt;
  return calib::pose_from_points(rig.scene, rig.pose);
}

// Distance to the farthest object; 0 if the pose is not known before the shots are opened.
double distance_to_camera_mm(const Rig& rig, const ObjectScenes& objects,
                             const std::optional<PoseResult>& pose) {
  if (!pose) return 0.0;
  const CameraView view{rig.scene.camera.intrinsics, pose->camera_from_world};
  double distance_mm = 0.0;
  for (const auto& [name, object] : objects) {
    distance_mm =
        std::max(distance_mm, (view.center_in_world_mm() - object.box.center_mm()).norm());
  }
  return distance_mm;
}

// Pose points that scatter by far more than the rig states about the best pose: lens or marks are
// not as stated, and no pose is right.
std::optional<Finding> scattered_points(const Rig& rig, const PoseResult& pose,
                                        const std::vector<std::size_t>& shots) {
  constexpr double kMostRatio = 2.0;
  constexpr double kLeastProbability = 1e-6;
  const double stated_px = rig.pose.options.point_std_px;
  const double dof =
      2.0 * static_cast<double>(std::count(pose.inlier.begin(), pose.inlier.end(), true)) - 6.0;
  const double ratio = pose.noise_std_px / stated_px;
  if (!(ratio > kMostRatio) || chi_square_tail(dof * ratio * ratio, dof) > kLeastProbability) {
    return std::nullopt;
  }
  return Finding{"pose points",
                 fmt::format("pose points scatter by {:.2g} px about the best camera pose, {:.1f} "
                             "times the {:.2g} px of pose.point_std_px",
                             pose.noise_std_px, ratio, stated_px),
                 "check camera.intrinsics (was the lens focused again?) and the marks' positions, "
                 "or state how well they were read",
                 shots};
}

// The estimate of all channels but those that the findings refuse.
std::vector<ChannelResult> estimate_others(const Scene& scene, LitObjects& lit,
                                           const std::vector<ObservedShot>& shots,
                                           const std::vector<Finding>& findings,
                                           const EstimateOptions& options, KeptLight& kept,
                                           Stopwatch& watch, Progress* progress) {
  Estimation estimation(scene, lit, shots, material_channels(scene, shots, options.channels),
                        options, kept, watch, progress);
  refuse(scene, findings, estimation);
  const bool any = std::any_of(estimation.results.begin(), estimation.results.end(),
                               [](const ChannelResult& r) { return !r.refused(); });
  if (any || findings.empty()) run(estimator(options.model), estimation);
  return std::move(estimation.results);
}

}  // namespace

Instrument::Instrument(const Rig& rig, const ObjectScenes& objects, const MeasureOptions& options,
                       Progress* progress)
    : rig_(rig),
      objects_(objects),
      options_(options),
      progress_(progress),
      pose_(shared_pose(rig)),
      lit_(rig.scene, objects, options.patch_size_mm, distance_to_camera_mm(rig, objects, pose_)) {
  if (!options.atlas_folder.empty()) {
    atlas_ = std::make_shared<AtlasFolder>(options.atlas_folder);
    kept_.atlas = std::make_shared<TransportAtlas>(atlas_);
  }
  if (!pose_ || rig.pose.refine_by_silhouette) return;
  // A view that the shots determine is that of no other measurement.
  if (!options.atlas_folder.empty()) {
    maps_.emplace(options.atlas_folder + "/views");
    weights_ = std::make_shared<WeightFolder>(options.atlas_folder + "/weights");
    kept_.store = weights_;
  }
  view_ = see_all(rig.scene, objects, lit_, *pose_, {}, rig.scene.objects_in_shots(),
                  maps_ ? &*maps_ : nullptr);
}

Measurement Instrument::measure(const capture::ShotSource& source) {
  std::vector<std::pair<std::string, double>> timing_s;
  Stopwatch watch(timing_s);
  Measurement out = measure(source, watch);
  watch.total();
  out.timing_s = timing_s;
  return out;
}

Measurement Instrument::measure(const capture::ShotSource& source, Stopwatch& watch) {
  std::vector<ObservedShot> shots;
  return measure(source, watch, false, shots);
}

Measurement Instrument::forecast(const capture::ShotSource& source,
                                 std::vector<ObservedShot>& opened) {
  std::vector<std::pair<std::string, double>> timing_s;
  Stopwatch watch(timing_s);
  return measure(source, watch, true, opened);
}

std::optional<SharedView> Instrument::view_of(const capture::ShotSource& source) {
  if (view_) return view_;
  kept_ = {{}, {}, kept_.atlas};  // without the light of previous views
  if (!pose_ || rig_.pose.per_shot) return std::nullopt;
  return see_all(rig_.scene, objects_, lit_,
                 calib::pose_from_silhouettes(rig_.scene, rig_.pose, objects_, *pose_, source), {},
                 rig_.scene.objects_in_shots());
}

FirstLook Instrument::look(const capture::ShotSource& source) {
  std::vector<std::pair<std::string, double>> timing_s;
  Stopwatch watch(timing_s);
  SeenShots seen(rig_, objects_, lit_, source, view_of(source), true, std::nullopt, kept_,
                 progress_);
  FirstLook out = look_first(source, true, seen, watch);
  out.shots = seen.shots();
  LightLook light(rig_.scene, lit_, out.shots, seen.kept().weights);
  for (std::size_t i = 0; i < out.shots.size(); ++i) out.likeness.push_back(light.likeness(i));
  return out;
}

// Opens the shots, looks at outlines, frames, lights and pose points meanwhile, and opens the shots
// again from where the outlines show the objects.
FirstLook Instrument::look_first(const capture::ShotSource& source, bool smooth, SeenShots& seen,
                                 Stopwatch& watch) {
  FrameWatch frame_watch(rig_.scene);
  std::optional<OutlineWatch> looks;
  if (view_) looks.emplace(rig_, objects_, *pose_);
  seen.open(capture::shown_to(
      [&](std::size_t shot_idx, const capture::RawFrame& frame) {
        if (looks) looks->look(shot_idx, frame);
        frame_watch.look(shot_idx, frame);
      },
      source));
  OutlineFindings outlines;
  if (looks) {
    outlines = looks->findings(source);
  } else if (const auto* open = std::get_if<capture::FrameSource>(&source.open);
             rig_.pose.charuco) {
    outlines = look_at_pieces(rig_, objects_, seen.shots(), *open);
  }
  const std::vector<Finding> of_frames = frame_watch.findings();
  // Shots of which something is wrong or a little off are looked at again next time.
  if (!of_frames.empty() || !outlines.findings.empty() || !outlines.shifts.empty() ||
      !outlines.sizes_open.empty()) {
    seen.forget();
  }
  if (!outlines.shifts.empty()) seen.open_from(outlines.shifts);
  if (!outlines.sizes_open.empty()) seen.leave_sizes_open(outlines.sizes_open);
  outlines.findings.insert(outlines.findings.begin(), of_frames.begin(), of_frames.end());
  watch.lap("shots");
  std::vector<Finding> of_light;
  if (smooth) {
    of_light = LightLook(rig_.scene, lit_, seen.shots(), seen.kept().weights).findings();
    if (const auto* frames = std::get_if<capture::FrameSource>(&source.open)) {
      find_displaced_round_bodies(rig_, objects_, seen.shots(), shots_of(of_light), *frames,
                                  outlines);
    }
    watch.lap("first look");
  }
  if (pose_) {
    if (auto points = scattered_points(rig_, *pose_, source.shot_idxs)) {
      outlines.findings.push_back(std::move(*points));
    }
  }
  return {{}, in_order(outlines.findings, of_light), outlines.notes, {}, outlines.diagnosis};
}

Measurement Instrument::measure(const capture::ShotSource& source, Stopwatch& watch,
                                bool without_noise, std::vector<ObservedShot>& opened) {
  EstimateOptions options = options_.estimate;
  options.without_noise = without_noise;
  if (without_noise) options.model = "dipole";
  Measurement out;
  out.model = options.model;
  for (const auto& [name, object] : objects_) {
    out.patch_size_mm[name] = lit_.patches(name).patch_size_mm();
  }
  const bool smooth = estimator(options.model).on_smooth_knots;
  std::optional<int> levels;
  if (options_.goal && smooth && !without_noise && options.model != "transport") {
    levels = kFirstLevels;
  }
  SeenShots seen(rig_, objects_, lit_, source, view_of(source), smooth, levels, kept_, progress_);
  FirstLook look;
  if (without_noise) {
    seen.open();
    watch.lap("shots");
  } else {
    look = look_first(source, smooth, seen, watch);
    out.notes = look.notes;
  }
  out.brackets = brackets_of(seen.shots());
  const auto fit = [&](const EstimateOptions& how) {
    return estimate_others(rig_.scene, lit_, seen.shots(), look.findings, how, seen.kept(), watch,
                           progress_);
  };
  for (;;) {
    options.all_rows = seen.all_rows();
    out.results = smooth && !without_noise
                      ? fitted_from_where_seen(rig_.scene, seen, options, fit, watch)
                      : fit(options);
    if (!seen.levels()) break;
    levels = levels_needed(out.results, *options_.goal, *seen.levels(), options.all_rows);
    if (levels == seen.levels()) break;
    seen.choose(levels);
  }
  const auto* frames = std::get_if<capture::FrameSource>(&source.open);
  if (!without_noise && frames != nullptr && look.findings.empty() &&
      std::any_of(out.results.begin(), out.results.end(), is_fitted_and_refused)) {
    if (view_) {
      tell_of_outline(outline_departure(rig_, objects_, *pose_, *frames, source.shot_idxs),
                      out.results);
    }
    tell_of_displaced_round_bodies(rig_, objects_, seen.shots(), *frames, out.results);
    tell_of_background(seen.shots(), out.results);
  }
  if (atlas_ && !atlas_->problem().empty()) {
    out.notes.push_back("paths of transport are not kept: " + atlas_->problem());
  }
  const std::string of_maps = maps_ ? maps_->write() : "";
  const std::string of_weights = weights_ ? weights_->write() : "";
  if (const std::string& problem = of_maps.empty() ? of_weights : of_maps; !problem.empty()) {
    out.notes.push_back("what depends on the jig is not kept: " + problem);
  }
  opened = seen.whole();
  out.places = std::make_shared<RigPlaces>(rig_places(rig_, objects_, opened));
  if (!without_noise) {
    refuse_blurred(opened, rig_.scene.camera.intrinsics.fx_px, out.results);
    if (const std::string noise = noise_note(opened); !noise.empty()) out.notes.push_back(noise);
  }
  out.skipped = skipped_of(opened, lit_);
  out.skipped.rows = rows_of(seen.whole()) - rows_of(seen.shots());
  for (const ChannelResult& r : out.results) out.skipped.nuisances += r.nuisances_negligible;
  out.skipped.channels_not_asked =
      material_channels(rig_.scene, opened).size() - out.results.size();
  return out;
}

}  // namespace scattermeter::apps
