#include "apps/instrument/instrument.h"

#include <algorithm>

#include "apps/instrument/fitted_view.h"
#include "apps/instrument/focus.h"
#include "apps/instrument/led_watch.h"
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
#include "apps/looks/piece_look.h"
#include "apps/looks/pose_points.h"
#include "calib/pose/shot_pose.h"
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
  FirstLook out = look_first(source, true, open_and_look(source, seen), seen, watch);
  out.shots = seen.shots();
  LightLook light(rig_.scene, lit_, out.shots, seen.kept().weights);
  for (std::size_t i = 0; i < out.shots.size(); ++i) out.likeness.push_back(light.likeness(i));
  return out;
}

// Opens the shots and looks at outlines and frames meanwhile.
OutlineFindings Instrument::open_and_look(const capture::ShotSource& source, SeenShots& seen) {
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
      !outlines.moved.empty() || !outlines.sizes_open.empty()) {
    seen.forget();
  }
  if (is_moved_) outlines.moved.clear();
  outlines.findings.insert(outlines.findings.begin(), of_frames.begin(), of_frames.end());
  return outlines;
}

// Opens the shots again from where the outlines show the objects, and looks at lights and pose
// points.
FirstLook Instrument::look_first(const capture::ShotSource& source, bool smooth,
                                 OutlineFindings outlines, SeenShots& seen, Stopwatch& watch) {
  if (!outlines.shifts.empty()) seen.open_from(outlines.shifts);
  if (!outlines.sizes_open.empty()) seen.leave_sizes_open(outlines.sizes_open);
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

// Nothing is kept of it: the shots put pieces and LEDs elsewhere for every measurement.
Measurement Instrument::measure_there(const Rig& rig, const ObjectScenes& objects, bool is_moved,
                                      int led_moves, const capture::ShotSource& source,
                                      Stopwatch& watch) const {
  MeasureOptions options = options_;
  options.atlas_folder.clear();
  Instrument there(rig, objects, options, progress_);
  there.is_moved_ = is_moved;
  there.led_moves_ = led_moves;
  capture::ShotSource unkept = source;
  unkept.cache = nullptr;
  return there.measure(unkept, watch);
}

Measurement Instrument::measure_moved(const capture::ShotSource& source, Stopwatch& watch,
                                      const MovedPieces& pieces) const {
  const std::unique_ptr<const MovedRig> moved = moved_rig(rig_, objects_, pieces);
  Measurement out = measure_there(moved->rig, moved->objects, true, led_moves_, source, watch);
  for (const auto& [name, piece] : pieces) out.notes.insert(out.notes.begin(), piece.note);
  return out;
}

Measurement Instrument::measure_relit(const capture::ShotSource& source, Stopwatch& watch,
                                      const LedDisplacements& leds) const {
  Rig rig = rig_;
  displace_leds(leds, rig.scene);
  return measure_there(rig, objects_, is_moved_, led_moves_ + 1, source, watch);
}

// What the shots show beside the fit, where it refuses them.
void Instrument::tell_of_shots(const capture::ShotSource& source, const SeenShots& seen,
                               std::vector<ChannelResult>& results) const {
  const auto* frames = std::get_if<capture::FrameSource>(&source.open);
  if (frames == nullptr || std::none_of(results.begin(), results.end(), is_fitted_and_refused)) {
    return;
  }
  if (view_) {
    tell_of_outline(outline_departure(rig_, objects_, *pose_, *frames, source.shot_idxs), results);
  }
  tell_of_displaced_round_bodies(rig_, objects_, seen.shots(), *frames, results);
  tell_of_background(seen.shots(), results);
}

void Instrument::tell_unkept(Measurement& out) {
  if (atlas_ && !atlas_->problem().empty()) {
    out.notes.push_back("paths of transport are not kept: " + atlas_->problem());
  }
  const std::string of_maps = maps_ ? maps_->write() : "";
  const std::string of_weights = weights_ ? weights_->write() : "";
  if (const std::string& problem = of_maps.empty() ? of_weights : of_maps; !problem.empty()) {
    out.notes.push_back("what depends on the jig is not kept: " + problem);
  }
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
    OutlineFindings outlines = open_and_look(source, seen);
    if (!outlines.moved.empty()) return measure_moved(source, watch, outlines.moved);
    look = look_first(source, smooth, std::move(outlines), seen, watch);
    out.notes = look.notes;
  }
  out.brackets = brackets_of(seen.shots());
  const auto fit = [&](const EstimateOptions& how) {
    return estimate_others(rig_.scene, lit_, seen.shots(), look.findings, how, seen.kept(), watch,
                           progress_);
  };
  const auto* frames = std::get_if<capture::FrameSource>(&source.open);
  OutlineFindings closer;
  bool has_looked = is_moved_ || without_noise || !view_ || frames == nullptr;
  const auto finds_elsewhere = [&] {
    if (!std::exchange(has_looked, true)) {
      closer = look_at_pieces(rig_, objects_, *pose_, seen.shots(), *frames);
    }
    return !closer.moved.empty() || !closer.findings.empty();
  };
  LedWatch leds(rig_.scene, seen, smooth && !without_noise && led_moves_ < kMostLedMoves);
  const auto finds_leds = [&](const auto& results) { return leds.finds(results); };
  for (;;) {
    options.all_rows = seen.all_rows();
    out.results = smooth && !without_noise
                      ? fitted_from_where_seen(rig_.scene, seen, options, fit, finds_elsewhere,
                                               finds_leds, watch)
                      : fit(options);
    if (!leds.found().empty()) return measure_relit(source, watch, leds.found());
    if (smooth && look.findings.empty() &&
        std::any_of(out.results.begin(), out.results.end(), is_fitted_and_refused)) {
      finds_elsewhere();
    }
    if (!closer.findings.empty()) {
      look.findings = in_order(std::move(closer.findings), std::move(look.findings));
      out.results = fit(options);
      break;
    }
    if (!closer.moved.empty()) return measure_moved(source, watch, closer.moved);
    if (!seen.levels()) break;
    levels = levels_needed(out.results, *options_.goal, *seen.levels(), options.all_rows);
    if (levels == seen.levels()) break;
    seen.choose(levels);
  }
  if (!without_noise && look.findings.empty()) tell_of_shots(source, seen, out.results);
  tell_unkept(out);
  opened = seen.whole();
  out.places = std::make_shared<RigPlaces>(rig_places(rig_, objects_, opened));
  if (!without_noise) {
    refuse_blurred(opened, rig_.scene.camera.intrinsics.fx_px, out.results);
    if (const std::string noise = noise_note(opened); !noise.empty()) out.notes.push_back(noise);
    if (led_moves_ > 0) out.notes.push_back(displaced_leds_note(rig_.scene));
  }
  out.skipped = skipped_of(opened, lit_);
  out.skipped.rows = rows_of(seen.whole()) - rows_of(seen.shots());
  for (const ChannelResult& r : out.results) out.skipped.nuisances += r.nuisances_negligible;
  out.skipped.channels_not_asked =
      material_channels(rig_.scene, opened).size() - out.results.size();
  return out;
}

}  // namespace scattermeter::apps
