#include "apps/led_shots.h"

#include <algorithm>
#include <filesystem>
#include <optional>

#include <fmt/core.h>

#include "apps/raw_shot.h"
#include "apps/shot_pose.h"
#include "apps/shot_samples.h"
#include "calib/highlight.h"
#include "calib/led_ambient.h"
#include "calib/plane_cells.h"
#include "core/input_error.h"

namespace scattermeter::apps {
namespace {

struct Rectangle {
  int x0, y0, width, height;
};

capture::CorrectedSamples samples_of(const Rig& rig, const RigLedShot& shot,
                                     const capture::RawFrame& frame, const Rectangle& r) {
  return frame_samples(rig, frame, shot.file, r.x0, r.y0, r.width, r.height);
}

void read_spheres(const Rig& rig, const RigLedShot& shot, const capture::RawFrame& frame,
                  std::size_t view, LedShots& out) {
  const Rigid3d& pose = out.scene.views[view].camera_from_world;
  for (std::size_t k = 0; k < out.scene.spheres.size(); ++k) {
    const std::string name = fmt::format("{} sphere {}", shot.file, k + 1);
    const calib::SphereImage image =
        calib::sphere_image(rig.camera.intrinsics, pose, out.scene.spheres[k]);
    if (image.width == 0) {
      out.notes.push_back(name + ": the sphere is out of view");
      continue;
    }
    const calib::FoundHighlight found = calib::find_highlight(
        samples_of(rig, shot, frame, {image.x0, image.y0, image.width, image.height}).samples,
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
  calib::PlaneCells cells;
  double exposure_relative_std;
};

PlaneSeen seen_plane(const Rig& rig, const RigLedShot& shot, const capture::RawFrame& frame,
                     const Rigid3d& pose, std::size_t view, const LedShots& out) {
  const calib::WhitePlane& plane = out.scene.planes.at(shot.plane);
  const calib::PlaneImage image = calib::plane_image(rig.camera.intrinsics, pose, plane);
  const std::string where = rig.at(shot.line) + ": calibration.led.shots." + shot.file;
  if (image.width < 2 || image.height < 2) {
    throw InputError(where,
                     fmt::format("plane {} is out of view or seen from behind", shot.plane + 1));
  }
  const capture::CorrectedSamples light =
      samples_of(rig, shot, frame, {image.x0, image.y0, image.width, image.height});
  calib::PlaneCellOptions options;
  options.keep_faint = shot.kind == LedShotKind::kAmbient;
  return {calib::plane_cells(light.samples, rig.camera.intrinsics, pose, plane, out.responsivity,
                             view, shot.plane, options),
          light.exposure_relative_std};
}

// `ambient`: the plane with the LED off, if that was shot.
void read_plane(const Rig& rig, const RigLedShot& shot, const capture::RawFrame& frame,
                std::size_t view, const std::optional<calib::PlaneCells>& ambient,
                std::vector<double>& exposures_s, LedShots& out) {
  PlaneSeen seen = seen_plane(rig, shot, frame, out.scene.views[view].camera_from_world, view, out);
  calib::PlaneCells& cells = seen.cells;
  if (ambient) cells = calib::without_ambient(cells, *ambient);
  // Shots of one stated time share its error.
  const auto known = std::find(exposures_s.begin(), exposures_s.end(), frame.exposure_s);
  const auto setting = static_cast<std::size_t>(known - exposures_s.begin());
  if (known == exposures_s.end()) {
    exposures_s.push_back(frame.exposure_s);
    out.scene.exposure_relative_std.push_back(seen.exposure_relative_std);
  }
  const std::size_t plane_shot = out.grids.size();
  for (calib::ShadedCell& cell : cells.cells) {
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

LedFrames led_frames_in(const Rig& rig, const std::string& shots_folder) {
  return [&rig, shots_folder](std::size_t i) {
    const RigLedShot& shot = rig.calibration.led->shots.at(i);
    const std::filesystem::path path = std::filesystem::path(shots_folder) / shot.file;
    std::error_code error;
    if (!std::filesystem::exists(path, error)) {
      throw InputError(shots_folder,
                       fmt::format("{} is missing, which {} lists", shot.file, rig.at(shot.line)));
    }
    return open_shot(rig, path.string());
  };
}

LedShots read_led_shots(const Rig& rig, const std::string& light, const LedFrames& frames) {
  if (!rig.calibration.led) {
    throw InputError(rig.path, "calibration.led: is missing: it lists spheres, planes and shots");
  }
  const RigLedCalibration& led = *rig.calibration.led;
  const auto known = [&] {
    for (const RigLight& l : rig.lights) {
      if (l.name == light) return !l.environment.has_value();
    }
    return false;
  };
  LedShots out;
  out.scene.intrinsics = rig.camera.intrinsics;
  out.scene.spheres = led.spheres;
  out.scene.planes = led.planes;
  std::array<double, 3> nominal{};
  nominal.fill(kNominalResponsivity);
  out.responsivity = rig.camera.responsivity.value_or(nominal);
  std::optional<calib::PoseResult> shared;
  std::vector<double> exposures_s;  // of the planes
  if (!rig.pose.charuco) shared = pose_from_points(rig);
  const auto ambient_of = [&](std::size_t plane) -> std::optional<calib::PlaneCells> {
    const auto at = led.ambient_shot(plane);
    if (!at) return std::nullopt;
    const RigLedShot& shot = led.shots[*at];
    const capture::RawFrame frame = frames(*at);
    const Rigid3d pose =
        (shared ? *shared : pose_from_board(rig, frame, shot.file)).camera_from_world;
    return seen_plane(rig, shot, frame, pose, 0, out).cells;
  };
  for (std::size_t i = 0; i < led.shots.size(); ++i) {
    const RigLedShot& shot = led.shots[i];
    if (shot.kind == LedShotKind::kAmbient || shot.light != light) continue;
    if (!known()) {
      throw InputError(rig.at(shot.line) + ": calibration.led.shots." + shot.file + ".light",
                       "no such LED in lights, got " + light);
    }
    const capture::RawFrame frame = frames(i);
    if (out.scene.views.empty() || !shared) {
      const calib::PoseResult pose = shared ? *shared : pose_from_board(rig, frame, shot.file);
      out.scene.views.push_back({pose.camera_from_world, pose.covariance});
      out.files.push_back(shot.file);
    }
    const std::size_t view = out.scene.views.size() - 1;
    if (shot.kind == LedShotKind::kPlane) {
      read_plane(rig, shot, frame, view, ambient_of(shot.plane), exposures_s, out);
    } else {
      read_spheres(rig, shot, frame, view, out);
    }
  }
  if (out.scene.views.empty()) {
    throw InputError(rig.at(led.line) + ": calibration.led.shots", "no shot of the light " + light);
  }
  return out;
}

}  // namespace scattermeter::apps
