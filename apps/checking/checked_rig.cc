#include "apps/checking/checked_rig.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <mutex>
#include <utility>

#include <fmt/core.h>
#include <oneapi/tbb/parallel_for.h>

#include "apps/instrument/calibration_inputs.h"
#include "apps/instrument/seen_shots.h"
#include "apps/looks/closer_look.h"
#include "apps/looks/displaced_round_bodies.h"
#include "apps/looks/first_look.h"
#include "apps/looks/frame_watch.h"
#include "apps/looks/moved_piece.h"
#include "apps/looks/piece_look.h"
#include "apps/looks/piece_places.h"
#include "apps/rig/open_objects.h"
#include "apps/rig/rig_led_agreement.h"
#include "calib/lens/lens_of_points.h"
#include "calib/pose/shot_pose.h"
#include "capture/files/file_kind.h"
#include "capture/sensor/corrected_samples.h"
#include "capture/sensor/linear_samples.h"
#include "capture/sensor/radiance_calibration.h"
#include "capture/shots/shot_folder.h"
#include "capture/shots/shot_source.h"
#include "core/base/progress.h"

namespace scattermeter::apps {
namespace {

// Least standard deviation of an LED's position in the joint fit.
constexpr double kLedPositionStd_mm = 2.0;

std::shared_ptr<CheckedGeometry> geometry_of(Rig stated) {
  auto out = std::make_shared<CheckedGeometry>();
  out->stated = std::move(stated);
  out->stated.scene.camera.sensor.noise = noise_in_force(out->stated);
  out->rig = out->stated;
  // The pose as stated: refining it would hide an error of the outlines.
  out->rig.pose.refine_by_silhouette = false;
  for (SceneLight& light : out->rig.scene.lights) {
    if (light.led() == nullptr) continue;
    if (light.led()->calibrated) {
      // Without correlations, as the position is to be found from the shots.
      const LedVector std = light.led()->calibrated->covariance.diagonal().cwiseSqrt();
      light.led()->axis_std_rad = std.segment<2>(kLedAxis).maxCoeff();
      light.led()->exponent_std = std[kLedExponent];
      light.led()->intensity_relative_std = std.tail<3>().maxCoeff();
      light.led()->calibrated.reset();
    }
    light.led()->position_std_mm = std::max(light.led()->position_std_mm, kLedPositionStd_mm);
  }
  out->objects = open_objects(out->rig);
  return out;
}

CheckedFrame checked_frame(const capture::RawFrame& frame, const Rig& rig, const ObservedShot& shot,
                           const CheckOptions& options) {
  CheckedFrame out;
  out.black_counts = frame.black_counts;
  const SampleMap& map = shot.seen->map;
  // A board fills the frame with light.
  if (!rig.pose.charuco) {
    out.background = capture::background_level(frame, map.x0, map.y0, map.width, map.height);
    if (rig.decoding.radiance) {
      // Known glare and dark current are not light of the background.
      const capture::RadianceCorrection& c = rig.decoding.radiance->correction;
      const std::array<double, kRgb> mean = capture::frame_mean_counts(frame, c);
      for (std::size_t k = 0; k < kRgb; ++k) {
        const double known = c.glare_share[k] * mean[k] + c.dark_counts_per_s[0] * frame.exposure_s;
        out.background.darkest_counts[k] -= known;
        out.background.median_counts[k] -= known;
      }
    }
  }
  out.noise = capture::noise_curve(
      capture::linear_samples(frame, rig.scene.camera.sensor.noise, frame.exposure_s, map.x0,
                              map.y0, map.width, map.height),
      map);
  if (options.draw_shot) {
    out.png = options.draw_shot(frame, {rig.scene.camera.intrinsics, shot.pose.camera_from_world},
                                *shot.seen->object->rays, map);
  }
  return out;
}

// The LEDs whose calibration shots are all in the folder.
std::vector<calib::LedCheck> checked_leds(const Rig& rig, const std::string& folder) {
  std::vector<calib::LedCheck> out;
  if (!rig.calibration.led) return out;
  const calib::LedCalibrationInput input = led_calibration_input(rig);
  for (const std::string& light : input.shots.lights()) {
    const bool all_there =
        std::all_of(input.shots.shots.begin(), input.shots.shots.end(),
                    [&](const calib::LedCalibrationShot& shot) {
                      return (shot.kind != calib::LedShotKind::kAmbient && shot.light != light) ||
                             capture::is_there(std::filesystem::path(folder) / shot.file);
                    });
    if (all_there) out.push_back(calib::check_led(input, light, led_frames_in(rig, folder)));
  }
  return out;
}

// Uncertainties of the lens that may explain shifts of the outlines.
calib::SilhouetteCheckOptions outline_options(const CheckedRig& checked) {
  calib::SilhouetteCheckOptions out;
  out.explanation.scale_relative_std = mesh_scale_std(checked.rig.scene);
  if (!checked.lens) return out;
  for (std::size_t i = 0; i < checked.lens->parameters.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    const double std = std::sqrt(checked.lens->covariance(at, at));
    const std::string& name = checked.lens->parameters[i];
    if (name.starts_with("f")) {
      out.explanation.focal_relative_std = std / checked.rig.scene.camera.intrinsics.fx_px;
    } else if (name == "k1") {
      out.explanation.k1_std = std;
    }
  }
  return out;
}

calib::SilhouetteCheck checked_outline(const CheckedGeometry& geometry,
                                       const capture::ShotSource& source,
                                       const CheckedRig& checked) {
  const Rig& rig = geometry.rig;
  const capture::FrameSource& frames = std::get<capture::FrameSource>(source.open);
  const calib::SilhouetteCheckOptions options = outline_options(checked);
  if (checked.shared_pose) {
    return calib::check_silhouettes(rig.scene, rig.pose, geometry.objects, frames, source.shot_idxs,
                                    *checked.shared_pose, options);
  }
  std::vector<PoseResult> poses;
  for (const ObservedShot& shot : checked.shots) poses.push_back(shot.pose);
  return calib::check_silhouettes_apart(rig.scene, rig.pose, geometry.objects, frames,
                                        source.shot_idxs, poses, options);
}

CheckedRig open_placed(Rig placed, const std::string& shots_folder, const CheckOptions& options,
                       std::vector<std::string> places, bool is_moved) {
  const auto geometry = geometry_of(std::move(placed));
  const Rig& rig = geometry->stated;
  CheckedRig out{rig, options, {}, {}, {}, {}, places, geometry, shots_folder, {}, {}, {}};
  const capture::ShotFolder folder =
      capture::match_shots(rig.scene, calibration_files(rig), shots_folder);
  for (const std::string& name : folder.unlisted) {
    out.notes.push_back(name + ": not in the rig's list of shots, skipped");
  }
  const Rig& loose = geometry->rig;
  if (!rig.pose.charuco) out.shared_pose = calib::pose_from_points(loose.scene, loose.pose);
  geometry->lit = std::make_unique<LitObjects>(loose.scene, geometry->objects, std::nullopt, 0.0);
  std::optional<SharedView> view;
  if (out.shared_pose) {
    view = see_all(loose.scene, geometry->objects, *geometry->lit, *out.shared_pose, {},
                   loose.scene.objects_in_shots());
  }
  const capture::ShotSource source =
      capture::shots_in_files(loose.scene, loose.decoding, folder.paths);
  KeptLight kept;
  SeenShots seen(loose, geometry->objects, *geometry->lit, source, std::move(view), false,
                 std::nullopt, kept, options.progress);
  seen.open();
  const auto& frames = std::get<capture::FrameSource>(source.open);
  out.frames.resize(seen.whole().size());
  FrameWatch frame_watch(loose.scene);
  std::optional<OutlineWatch> watch;
  if (out.shared_pose) watch.emplace(loose, geometry->objects, *out.shared_pose);
  ProgressStage stage(options.progress, "looking at shots", out.frames.size());
  tbb::parallel_for(std::size_t{0}, out.frames.size(), [&](std::size_t i) {
    const capture::RawFrame frame = frames(source.shot_idxs[i], 0);
    out.frames[i] = checked_frame(frame, loose, seen.whole()[i], options);
    frame_watch.look(source.shot_idxs[i], frame);
    if (watch) watch->look(source.shot_idxs[i], frame);
    stage.step();
  });
  out.looks = watch ? watch->findings(source)
                    : look_at_pieces(loose, geometry->objects, seen.whole(), frames);
  // `measure` measures there, too.
  if (!is_moved && !out.looks->moved.empty()) {
    Rig moved = rig;
    move_pieces(out.looks->moved, moved.scene);
    for (const auto& [name, piece] : out.looks->moved) places.push_back(piece.note);
    return open_placed(std::move(moved), shots_folder, options, std::move(places), true);
  }
  out.notes.insert(out.notes.end(), out.looks->notes.begin(), out.looks->notes.end());
  const std::vector<Finding> of_frames = frame_watch.findings();
  out.looks->findings.insert(out.looks->findings.begin(), of_frames.begin(), of_frames.end());
  // `measure` begins there, too.
  if (!out.looks->shifts.empty()) seen.open_from(out.looks->shifts);
  if (rig.lens) out.lens = *rig.lens;
  out.leds = checked_leds(rig, shots_folder);
  out.fit = fit_for_check(rig.scene, loose, source, seen, out.looks->findings, *geometry->lit,
                          options.progress);
  out.shots = seen.whole();
  find_displaced_round_bodies(loose, geometry->objects, out.shots, shots_of(out.fit.findings),
                              frames, *out.looks);
  out.outline = checked_outline(*geometry, source, out);
  if (!rig.scene.camera.responsivity) {
    out.notes.emplace_back(
        "no responsivity in the rig: the scale is free, sigma_a will be uncertain");
  }
  return out;
}

}  // namespace

std::vector<Finding> CheckedRig::findings() const {
  return in_order(looks ? looks->findings : std::vector<Finding>(), fit.findings);
}

CheckDetail CheckedRig::of_shot(std::size_t shot_idx, double value) const {
  CheckDetail out;
  out.where = rig.scene.shots.at(shot_idx).file;
  out.value = value;
  out.shot_idx = shot_idx;
  return out;
}

CheckDetail CheckedRig::of_channel(std::size_t shot_idx, std::size_t channel, double value) const {
  CheckDetail out = of_shot(shot_idx, value);
  out.where += fmt::format(" {}", kRgbName.at(channel));
  return out;
}

CheckedRig open_checked_rig(const Rig& given, const std::string& shots_folder,
                            const CheckOptions& options) {
  require_radiance_of_leds(given);
  Rig placed = given;
  const std::string lens =
      calib::take_points_and_lens(placed.scene, placed.decoding, shots_folder, placed.pose);
  std::vector<std::string> notes = place_pieces(placed, shots_folder, options.progress);
  if (!lens.empty()) notes.insert(notes.begin(), lens);
  return open_placed(std::move(placed), shots_folder, options, std::move(notes), false);
}

}  // namespace scattermeter::apps
