#include "calib/led/led_shots.h"

#include <algorithm>
#include <optional>

#include <fmt/core.h>

#include "calib/led/highlight.h"
#include "calib/led/led_ambient.h"
#include "calib/led/plane_cells.h"
#include "capture/sensor/frame_samples.h"
#include "core/base/input_error.h"

namespace scattermeter::calib {
namespace {

capture::CorrectedSamples samples_of(const LedCalibrationInput& input,
                                     const LedCalibrationShot& shot, const capture::RawFrame& frame,
                                     const PixelRect& rect) {
  return capture::frame_samples(frame, input.noise, input.correction ? &*input.correction : nullptr,
                                shot.file, rect);
}

void read_spheres(const LedCalibrationInput& input, const LedCalibrationShot& shot,
                  const capture::RawFrame& frame, std::size_t view, LedShots& out) {
  const Rigid3d& pose = out.scene.views[view].camera_from_world;
  for (std::size_t k = 0; k < out.scene.spheres.size(); ++k) {
    const std::string name = fmt::format("{} sphere {}", shot.file, k + 1);
    const SphereImage image = sphere_image(input.intrinsics, pose, out.scene.spheres[k]);
    if (image.width == 0) {
      out.notes.push_back(name + ": the sphere is out of view");
      continue;
    }
    const FoundHighlight found = find_highlight(
        samples_of(input, shot, frame, {image.x0, image.y0, image.width, image.height}).samples,
        image);
    if (!found.problem.empty()) {
      out.notes.push_back(name + ": " + found.problem);
      continue;
    }
    out.scene.highlights.push_back({view, k, found.image_px, found.std_px});
    out.highlight_names.push_back(name);
  }
}

struct PlaneSeen {
  PlaneCells cells;
  double exposure_relative_std;
};

PlaneSeen seen_plane(const LedCalibrationInput& input, const LedCalibrationShot& shot,
                     const capture::RawFrame& frame, const Rigid3d& pose, std::size_t view,
                     const LedShots& out) {
  const WhitePlane& plane = out.scene.planes.at(shot.plane);
  const PlaneImage image = plane_image(input.intrinsics, pose, plane);
  const std::string where = input.shots.at(shot.line) + ": calibration.led.shots." + shot.file;
  if (image.width < 2 || image.height < 2) {
    throw InputError(where,
                     fmt::format("plane {} is out of view or seen from behind", shot.plane + 1));
  }
  const capture::CorrectedSamples light =
      samples_of(input, shot, frame, {image.x0, image.y0, image.width, image.height});
  PlaneCellOptions options;
  options.keep_faint = shot.kind == LedShotKind::kAmbient;
  return {plane_cells(light.samples, input.intrinsics, pose, plane, out.responsivity, view,
                      shot.plane, options),
          light.exposure_relative_std};
}

// `ambient`: the plane with the LED off, if there is such a shot.
void read_plane(const LedCalibrationInput& input, const LedCalibrationShot& shot,
                const capture::RawFrame& frame, std::size_t view,
                const std::optional<PlaneCells>& ambient, std::vector<double>& exposures_s,
                LedShots& out) {
  PlaneSeen seen =
      seen_plane(input, shot, frame, out.scene.views[view].camera_from_world, view, out);
  PlaneCells& cells = seen.cells;
  if (ambient) cells = without_ambient(cells, *ambient);
  // Shots with the same stated time have the same error of it.
  const auto known = std::find(exposures_s.begin(), exposures_s.end(), frame.exposure_s);
  const auto setting = static_cast<std::size_t>(known - exposures_s.begin());
  if (known == exposures_s.end()) {
    exposures_s.push_back(frame.exposure_s);
    out.scene.exposure_relative_std.push_back(seen.exposure_relative_std);
  }
  const std::size_t plane_shot = out.grids.size();
  for (ShadedCell& cell : cells.cells) {
    cell.setting = setting;
    cell.shot = plane_shot;
  }
  out.scene.ambient_subtracted.push_back(ambient.has_value());
  if (cells.cells.empty()) {
    out.notes.push_back(shot.file + (cells.clipped_cells > 0
                                         ? ": the plane is clipped all over: expose shorter"
                                         : ": no usable sample of the plane"));
  } else if (cells.clipped_cells > 0) {
    out.notes.push_back(fmt::format("{}: {} cells of the plane are clipped and left out", shot.file,
                                    cells.clipped_cells));
  }
  out.grids.push_back({shot.file, plane_shot, cells.columns, cells.rows});
  out.scene.cells.insert(out.scene.cells.end(), cells.cells.begin(), cells.cells.end());
}

}  // namespace

LedShots read_led_shots(const LedCalibrationInput& input, const std::string& light,
                        const LedFrames& frames) {
  const LedCalibrationShots& led = input.shots;
  const bool is_known = std::any_of(input.leds.begin(), input.leds.end(),
                                    [&](const PriorLed& prior) { return prior.name == light; });
  LedShots out;
  out.scene.intrinsics = input.intrinsics;
  out.scene.spheres = led.spheres;
  out.scene.planes = led.planes;
  std::array<double, 3> nominal{};
  nominal.fill(kNominalResponsivity);
  out.responsivity = input.responsivity_counts_mm2_sr_per_W_s.value_or(nominal);
  std::optional<PoseResult> pose;
  const auto find_pose = [&](const capture::RawFrame& frame, const std::string& file) {
    if (!pose || !input.pose.is_shared) pose = input.pose.estimate(frame, file);
  };
  std::vector<double> exposures_s;  // of the planes
  for (std::size_t i = 0; i < led.shots.size(); ++i) {
    const LedCalibrationShot& shot = led.shots[i];
    if (shot.kind == LedShotKind::kAmbient || shot.light != light) continue;
    if (!is_known) {
      throw InputError(led.at(shot.line) + ": calibration.led.shots." + shot.file + ".light",
                       "no such LED in lights, got " + light);
    }
    const capture::RawFrame frame = frames(i);
    find_pose(frame, shot.file);
    if (out.scene.views.empty() || !input.pose.is_shared) {
      out.scene.views.push_back({pose->camera_from_world, pose->covariance});
      out.files.push_back(shot.file);
    }
    const std::size_t view = out.scene.views.size() - 1;
    if (shot.kind == LedShotKind::kSpheres) {
      read_spheres(input, shot, frame, view, out);
      continue;
    }
    std::optional<PlaneCells> ambient;
    if (const auto ambient_idx = led.ambient_shot(shot.plane)) {
      const LedCalibrationShot& ambient_shot = led.shots[*ambient_idx];
      const capture::RawFrame ambient_frame = frames(*ambient_idx);
      find_pose(ambient_frame, ambient_shot.file);
      ambient =
          seen_plane(input, ambient_shot, ambient_frame, pose->camera_from_world, 0, out).cells;
    }
    read_plane(input, shot, frame, view, ambient, exposures_s, out);
  }
  if (out.scene.views.empty()) {
    throw InputError(led.at(led.line) + ": calibration.led.shots", "no shot of the light " + light);
  }
  return out;
}

}  // namespace scattermeter::calib
