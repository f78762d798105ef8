#include "apps/simulation/simulate.h"

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <system_error>

#include <fmt/core.h>

#include "apps/rig/open_objects.h"
#include "apps/simulation/chosen_exposure.h"
#include "apps/simulation/simulate_camera_calibration.h"
#include "apps/simulation/simulate_led_calibration.h"
#include "apps/simulation/simulate_radiance_calibration.h"
#include "apps/simulation/virtual_shots.h"
#include "capture/files/file_kind.h"
#include "capture/raw/raw_reader.h"
#include "capture/sensor/virtual_sensor.h"
#include "core/base/input_error.h"
#include "core/base/progress.h"

namespace scattermeter::apps {
namespace {

double board_exposure_s(const Rig& rig) {
  return rig.scene.camera.exposure_s.value_or(kDefaultExposure_s);
}

std::vector<float> board_signal_counts(const Rig& rig) {
  const calib::CharucoBoard& board = *rig.pose.charuco;
  CameraView view = true_view(rig);
  view.camera_from_world = view.camera_from_world * board.world_from_board;
  return board_counts(rig, view,
                      {calib::BoardKind::kCharuco, board.squares_x, board.squares_y,
                       board.square_mm, board.marker_mm, board.dictionary},
                      rig.at(rig.pose.line) + ": pose.charuco", rig.pose.board_shot);
}

std::string write_board_shot(const Rig& rig, const std::string& out_folder,
                             const SimulateOptions& options) {
  const std::string path = (std::filesystem::path(out_folder) / rig.pose.board_shot).string();
  capture::VirtualSensor(rig.scene, rig.truth.sensor, options.noise)
      .write(path, board_signal_counts(rig), board_exposure_s(rig),
             capture::VirtualSensor::stream(options.seed, rig.pose.board_shot));
  return path;
}

// The rig whose camera writes files of that format.
Rig with_format(Rig rig, capture::RawFormat format) {
  rig.truth.sensor.format = format;
  if (format != capture::RawFormat::kNef) return rig;
  SceneCamera& camera = rig.scene.camera;
  const std::string file = rig.scene.source;
  if (const std::string d80 = capture::RawMetadata{}.model;
      !camera.model.empty() && camera.model != d80) {
    throw InputError(file + ": camera.model",
                     "is " + camera.model + ", but NEF files are only written as those of a " +
                         d80 + "; write DNG files, or set camera.model to " + d80);
  }
  if (camera.sensor.white_counts != capture::RawMetadata{}.white_counts) {
    throw InputError(
        file + ": camera.sensor.white_counts",
        "is " + std::to_string(camera.sensor.white_counts) +
            ", but the white level of a NEF is 4095; leave it out, or write DNG files");
  }
  camera.sensor.nef_lossy_curve = true;
  return rig;
}

// Of all files that the rig names.
void require_no_camera_file(const Rig& rig, const std::string& folder) {
  std::set<std::string> names = calibration_files(rig);
  for (const SceneShot& shot : rig.scene.shots) {
    for (const std::string& file : shot.files()) names.insert(file);
  }
  if (!rig.pose.board_shot.empty()) names.insert(rig.pose.board_shot);
  for (const std::string& name : names) {
    const std::string path = (std::filesystem::path(folder) / name).string();
    if (!capture::is_there(path)) continue;
    if (const std::string writer = capture::writer_of_raw(path); writer != "scattermeter") {
      throw InputError(path,
                       "exists and is not from `simulate`: it would be replaced; choose "
                       "another folder");
    }
  }
}

}  // namespace

capture::RawFrame board_frame(const Rig& rig) {
  return capture::VirtualSensor(rig.scene, rig.truth.sensor, false)
      .frame(board_signal_counts(rig), board_exposure_s(rig), 0);
}

SimulatedShots simulate(const Rig& given_rig, const std::string& out_folder,
                        const SimulateOptions& options, Progress* progress) {
  const Rig given = with_format(given_rig, options.format);
  require_no_camera_file(given, out_folder);
  const CameraIntrinsics& lens = given.scene.camera.intrinsics;
  if (lens.width_px % 2 != 0 || lens.height_px % 2 != 0) {
    throw InputError(
        given.path + ": camera.image_size_px",
        fmt::format("raw files have even sides, got {} x {}", lens.width_px, lens.height_px));
  }
  // A board with a shot of its own is in no other shot.
  Rig rig = given;
  if (!rig.pose.board_shot.empty()) {
    true_view(given);  // throws if the rig has no pose of the camera
    rig.pose.charuco.reset();
  }
  ObjectScenes objects;
  std::optional<VirtualShots> shots;
  if (options.scene) {
    objects = open_objects(rig);
    RenderTransport transport = options.transport;
    transport.seed = options.seed;
    shots.emplace(rig, objects, VirtualShotOptions{options.noise, progress, transport});
  }
  SimulatedShots made;
  if (options.transport.peers != nullptr && options.transport.peers->rank() > 0) return made;
  std::error_code error;
  std::filesystem::create_directories(out_folder, error);
  if (error) throw InputError(out_folder, "the folder cannot be created: " + error.message());
  if (!given.pose.board_shot.empty()) {
    made.paths.push_back(write_board_shot(given, out_folder, options));
  }
  if (shots) {
    ProgressStage stage(progress, "exposing", shots->size());
    made.monte_carlo_std = shots->monte_carlo_std();
    for (std::size_t i = 0; i < shots->size(); ++i) {
      const std::vector<std::string> files = rig.scene.shots[i].files();
      for (std::size_t k = 0; k < files.size(); ++k) {
        made.paths.push_back((std::filesystem::path(out_folder) / files[k]).string());
        shots->write(i, options.seed, made.paths.back(), k);
        made.levels.push_back({files[k], shots->exposure_s(i, k), shots->brightest_share(i, k)});
      }
      stage.step();
    }
  }
  if (options.calibration) {
    for (const auto& part :
         {simulate_camera_calibration, simulate_led_calibration, simulate_radiance_calibration}) {
      const std::vector<std::string> paths = part(rig, out_folder, options, progress);
      made.paths.insert(made.paths.end(), paths.begin(), paths.end());
    }
  }
  return made;
}

}  // namespace scattermeter::apps
