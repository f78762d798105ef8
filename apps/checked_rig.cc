#include "apps/checked_rig.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <mutex>
#include <utility>

#include <fmt/core.h>
#include <oneapi/tbb/parallel_for.h>

#include "apps/file_kind.h"
#include "apps/progress.h"
#include "apps/radiance_file.h"
#include "apps/shot_folder.h"
#include "apps/shot_picture.h"
#include "apps/shot_pose.h"
#include "apps/shot_source.h"
#include "capture/corrected_samples.h"
#include "capture/linear_samples.h"

namespace scattermeter::apps {
namespace {

// An LED's place is fitted within at least this, mm.
constexpr double kLedPlaceStd_mm = 2.0;
constexpr int kPictureWidth_px = 420;

std::shared_ptr<CheckedGeometry> geometry_of(const Rig& rig) {
  auto out = std::make_shared<CheckedGeometry>();
  out->rig = rig;
  // The pose as the rig states it: a refined one would hide what is looked for.
  out->rig.pose.refine_by_silhouette = false;
  for (RigLight& light : out->rig.lights) {
    if (light.environment) continue;
    if (light.calibrated) {
      // Position, exponent and power by themselves: the places are what is asked for here.
      const calib::LedVector std = light.calibrated->covariance.diagonal().cwiseSqrt();
      light.exponent_std = std[5];
      light.power_relative_std = std.tail<3>().maxCoeff();
      light.calibrated.reset();
    }
    light.position_std_mm = std::max(light.position_std_mm, kLedPlaceStd_mm);
  }
  out->scenes = open_objects(out->rig);
  return out;
}

CheckedFrame checked_frame(const capture::RawFrame& frame, const Rig& rig, const OpenedShot& shot,
                           const CheckOptions& options) {
  CheckedFrame out;
  out.black_counts = frame.black_counts;
  const SampleMap& map = shot.seen->map;
  // A board fills the frame with light.
  if (!rig.pose.charuco) {
    out.background = capture::background_level(frame, map.x0, map.y0, map.width, map.height);
    if (rig.camera.radiance) {
      // What is known to lie on the background is none of its own light.
      const capture::RadianceCorrection& c = rig.camera.radiance->correction;
      const std::array<double, kRgb> mean = capture::frame_mean_counts(frame, c);
      for (std::size_t k = 0; k < kRgb; ++k) {
        const double known = c.glare_share[k] * mean[k] + c.dark_counts_per_s[0] * frame.exposure_s;
        out.background.darkest_counts[k] -= known;
        out.background.median_counts[k] -= known;
      }
    }
  }
  out.noise =
      capture::noise_curve(capture::linear_samples(frame, rig.camera.sensor.noise, frame.exposure_s,
                                                   map.x0, map.y0, map.width, map.height),
                           map);
  if (!options.pictures) return out;
  out.png = shot_picture(frame, {rig.camera.intrinsics, shot.pose.camera_from_world},
                         *shot.seen->object->rays, map, kPictureWidth_px);
  return out;
}

// The LEDs whose shots stand in the folder.
std::vector<LedCheck> checked_leds(const Rig& rig, const std::string& folder) {
  std::vector<LedCheck> out;
  if (!rig.calibration.led) return out;
  for (const std::string& light : rig.calibration.led->lights()) {
    const bool all_there =
        std::all_of(rig.calibration.led->shots.begin(), rig.calibration.led->shots.end(),
                    [&](const RigLedShot& shot) {
                      return (shot.kind != LedShotKind::kAmbient && shot.light != light) ||
                             is_there(std::filesystem::path(folder) / shot.file);
                    });
    if (all_there) out.push_back(check_led(rig, light, led_frames_in(rig, folder)));
  }
  return out;
}

}  // namespace

CheckDetail CheckedRig::of_shot(std::size_t shot_idx, double value) const {
  CheckDetail out;
  out.where = rig.shots.at(shot_idx).file;
  out.value = value;
  out.shot_idx = shot_idx;
  return out;
}

CheckDetail CheckedRig::of_channel(std::size_t shot_idx, std::size_t channel, double value) const {
  CheckDetail out = of_shot(shot_idx, value);
  out.where += fmt::format(" {}", kRgbName.at(channel));
  return out;
}

CheckedRig open_checked_rig(const Rig& rig, const std::string& shots_folder,
                            const CheckOptions& options) {
  CheckedRig out{rig, options, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}};
  const ShotFolder folder = match_shots(rig, shots_folder);
  for (const std::string& name : folder.unlisted) {
    out.notes.push_back(name + ": not in the rig's list of shots, skipped");
  }
  const auto geometry = geometry_of(rig);
  out.geometry = geometry;
  out.folder = shots_folder;
  const Rig& loose = geometry->rig;
  if (!rig.pose.charuco) out.shared_pose = pose_from_points(loose);
  geometry->library = std::make_unique<ObjectLibrary>(loose, geometry->scenes, std::nullopt, 0.0);
  std::optional<SharedView> view;
  if (out.shared_pose) {
    view = see_all(loose, geometry->scenes, *geometry->library, *out.shared_pose);
  }
  const ShotSource source = shots_in_files(loose, folder.paths);
  out.shots = open_shots(loose, source, geometry->scenes, *geometry->library, view, options.quiet);
  out.frames.resize(out.shots.size());
  Progress progress("looking at shots", static_cast<int>(out.shots.size()), options.quiet);
  tbb::parallel_for(std::size_t{0}, out.shots.size(), [&](std::size_t i) {
    const capture::RawFrame frame = std::get<FrameSource>(source.open)(source.shot_idxs[i], 0);
    out.frames[i] = checked_frame(frame, loose, out.shots[i], options);
    progress.step();
  });
  SilhouetteCheckOptions outline;
  if (rig.camera.lens) {
    out.lens = *rig.camera.lens;
    for (std::size_t i = 0; i < out.lens->parameters.size(); ++i) {
      const auto at = static_cast<Eigen::Index>(i);
      const double std = std::sqrt(out.lens->covariance(at, at));
      const std::string& name = out.lens->parameters[i];
      if (name.starts_with("f")) {
        outline.explanation.focal_relative_std = std / rig.camera.intrinsics.fx_px;
      } else if (name == "k1") {
        outline.explanation.k1_std = std;
      }
    }
  }
  const FrameSource& frames = std::get<FrameSource>(source.open);
  if (out.shared_pose) {
    out.outline = check_silhouettes(loose, geometry->scenes, frames, source.shot_idxs,
                                    *out.shared_pose, outline);
  } else {
    std::vector<calib::PoseResult> poses;
    for (const OpenedShot& shot : out.shots) poses.push_back(shot.pose);
    out.outline =
        check_silhouettes_apart(loose, geometry->scenes, frames, source.shot_idxs, poses, outline);
  }
  out.leds = checked_leds(rig, shots_folder);
  out.fit = fit_for_check(loose, source, out.shots, *geometry->library, view, options.quiet);
  if (!rig.camera.responsivity) {
    out.notes.emplace_back(
        "no responsivity in the rig: the scale is free, sigma_a will be uncertain");
  }
  return out;
}

}  // namespace scattermeter::apps
